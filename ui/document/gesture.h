// RAII for Document gestures: press opens, release commits, Esc or destruction rolls back.
#pragma once

#include "ui/document/document.h"

namespace atrium::ui {

/// One undo entry for everything applied while it lives. Rolls back unless commit() was called.
class Gesture {
public:
    Gesture(Document& document, const QString& text) : document_(&document) { document.begin_gesture(text); }
    ~Gesture() {
        if (document_ != nullptr) {
            document_->cancel_gesture();
        }
    }
    Gesture(const Gesture&) = delete;
    Gesture& operator=(const Gesture&) = delete;
    void commit() {
        document_->commit_gesture();
        document_ = nullptr;
    }

private:
    Document* document_;
};

} // namespace atrium::ui
