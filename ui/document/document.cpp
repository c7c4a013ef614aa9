#include "ui/document/document.h"

#include <QUndoCommand>

namespace atrium::ui {

namespace {
constexpr int kUndoLimit = 500; // entries hold values, not scenes; meshes and images are shared
}

/// One undo entry. The first redo() is the push itself, when the scene already has the change.
class EditCommand : public QUndoCommand {
public:
    EditCommand(Document& document, SceneEdit forward, SceneEdit inverse, const QString& text)
        : QUndoCommand(text), document_(document), forward_(std::move(forward)), inverse_(std::move(inverse)) {}
    void redo() override {
        if (applied_) {
            applied_ = false;
            return;
        }
        if (!document_.apply_now(forward_)) {
            setObsolete(true);
        }
    }
    void undo() override {
        if (!document_.apply_now(inverse_)) {
            setObsolete(true);
        }
    }

private:
    Document& document_;
    SceneEdit forward_;
    SceneEdit inverse_;
    bool applied_ = true;
};

Document::Document(QObject* parent) : QObject(parent) { undo_.setUndoLimit(kUndoLimit); }

Document::~Document() = default;

void Document::reset(Scene scene, const QString& path, std::vector<Problem> problems) {
    gesture_depth_ = 0;
    gesture_ = {};
    selection_.clear();
    scene_ = std::move(scene);
    path_ = path;
    problems_ = std::move(problems);
    ++revision_;
    undo_.clear();
    Q_EMIT reset_done();
    Q_EMIT path_changed();
}

void Document::set_path(const QString& path) {
    path_ = path;
    undo_.setClean();
    Q_EMIT path_changed();
}

Result<void> Document::apply(const SceneEdit& edit, const QString& text) {
    if (changes_nothing(scene_, edit)) {
        return {};
    }
    auto inverse = apply_now(edit);
    if (!inverse) {
        return tl::unexpected<Error>(inverse.error());
    }
    if (gesture_depth_ == 0) {
        undo_.push(new EditCommand(*this, edit, std::move(*inverse), text));
        return {};
    }
    gesture_.absorb(edit, *inverse);
    return {};
}

void Document::begin_gesture(const QString& text) {
    if (gesture_depth_++ == 0) {
        gesture_text_ = text;
    }
}

void Document::commit_gesture() {
    if (gesture_depth_ == 0 || --gesture_depth_ > 0) {
        return;
    }
    UndoEntry entry = gesture_.take();
    // When every inverse is what the scene already holds, the gesture ended where it began.
    if (!changes_nothing(scene_, entry.inverse)) {
        undo_.push(new EditCommand(*this, std::move(entry.forward), std::move(entry.inverse), gesture_text_));
    }
    Q_EMIT gesture_finished();
}

void Document::cancel_gesture() {
    if (gesture_depth_ == 0) {
        return;
    }
    --gesture_depth_;
    const SceneEdit back = gesture_.take().inverse;
    if (!changes_nothing(scene_, back)) {
        (void)apply_now(back); // restores values that were there before: nothing in it can be refused
    }
    if (gesture_depth_ == 0) {
        Q_EMIT gesture_finished();
    }
}

void Document::undo() {
    if (!in_gesture()) {
        undo_.undo();
    }
}

void Document::redo() {
    if (!in_gesture()) {
        undo_.redo();
    }
}

Result<SceneEdit> Document::apply_now(const SceneEdit& edit) {
    auto inverse = atrium::apply(scene_, edit);
    if (!inverse) {
        return inverse;
    }
    ++revision_;
    std::vector<NodeId> live = selection_.nodes();
    std::erase_if(live, [this](NodeId id) { return !scene_.nodes.contains(id); });
    Q_EMIT edited(edit);
    selection_.set(std::move(live));
    return inverse;
}

} // namespace atrium::ui
