// The bar above the view that offers to correct a file's units or direction; it never acts by itself.
#pragma once

#include "engine/scene/problems.h"

#include <QFrame>

class QLabel;

namespace atrium::ui {

/// UI thread only.
class ImportBar : public QFrame {
    Q_OBJECT
public:
    explicit ImportBar(QWidget* parent = nullptr);
    void offer(const ImportSuggestion& suggestion);
    void dismiss() { hide(); }

Q_SIGNALS:
    void accepted(const atrium::ImportSuggestion& suggestion);

private:
    ImportSuggestion suggestion_;
    QLabel* text_ = nullptr;
};

} // namespace atrium::ui
