#include "ui/document/document.h"

#include "ui/document/edit_tools.h"

#include <QUndoCommand>

#include <algorithm>

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
    gesture_done_.clear();
    gesture_inverse_.clear();
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
    // A group whose inverse has the same parts in reverse is kept part by part, so that dragging several objects merges too.
    const auto* group = std::get_if<EditGroup>(&edit.value);
    const auto* undo_group = std::get_if<EditGroup>(&inverse->value);
    if (group != nullptr && undo_group != nullptr && group->edits.size() == undo_group->edits.size()) {
        for (std::size_t i = 0; i < group->edits.size(); ++i) {
            absorb(group->edits[i], undo_group->edits[group->edits.size() - 1 - i]);
        }
    } else {
        absorb(edit, *inverse);
    }
    return {};
}

void Document::absorb(const SceneEdit& edit, const SceneEdit& inverse) {
    if (replaces_value(edit)) {
        for (std::size_t i = gesture_done_.size(); i-- > 0;) {
            if (supersedes(edit, gesture_done_[i])) {
                gesture_done_[i] = edit; // its inverse already leads back to the start of the gesture
                return;
            }
            if (!replaces_value(gesture_done_[i])) {
                break; // never move an edit across one that makes or removes what it refers to
            }
        }
    }
    gesture_done_.push_back(edit);
    gesture_inverse_.push_back(inverse);
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
    std::vector<SceneEdit> inverse(gesture_inverse_.rbegin(), gesture_inverse_.rend());
    std::vector<SceneEdit> forward = std::move(gesture_done_);
    gesture_done_.clear();
    gesture_inverse_.clear();
    // When every inverse is what the scene already holds, the gesture ended where it began.
    const bool null =
        std::all_of(inverse.begin(), inverse.end(), [this](const SceneEdit& edit) { return changes_nothing(scene_, edit); });
    if (!null) {
        undo_.push(new EditCommand(*this, as_one(std::move(forward)), as_one(std::move(inverse)), gesture_text_));
    }
    Q_EMIT gesture_finished();
}

void Document::cancel_gesture() {
    if (gesture_depth_ == 0) {
        return;
    }
    --gesture_depth_;
    std::vector<SceneEdit> inverse(gesture_inverse_.rbegin(), gesture_inverse_.rend());
    gesture_done_.clear();
    gesture_inverse_.clear();
    if (!inverse.empty()) {
        const SceneEdit back = as_one(std::move(inverse));
        if (!changes_nothing(scene_, back)) {
            (void)apply_now(back); // restores values that were there before: nothing in it can be refused
        }
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
