// The open project: scene, revision, undo, file. Panels and viewport observe it; every change is a SceneEdit.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/edit_tools.h"
#include "engine/scene/problems.h"
#include "engine/scene/scene_edit.h"
#include "ui/document/selection.h"

#include <QObject>
#include <QString>
#include <QUndoStack>

#include <cstdint>
#include <vector>

namespace atrium::ui {

/// UI thread only. There is always a document; a new one is an empty scene.
class Document : public QObject {
    Q_OBJECT
public:
    explicit Document(QObject* parent = nullptr);
    ~Document() override;

    [[nodiscard]] const Scene& scene() const { return scene_; }
    [[nodiscard]] std::uint64_t revision() const { return revision_; } ///< rises with every applied edit, undo included
    [[nodiscard]] QUndoStack* undo_stack() { return &undo_; }
    [[nodiscard]] Selection* selection() { return &selection_; }
    [[nodiscard]] const QString& path() const { return path_; } ///< empty while unsaved
    [[nodiscard]] const std::vector<Problem>& problems() const { return problems_; }
    [[nodiscard]] bool in_gesture() const { return gesture_depth_ != 0; }

    /// Replaces everything (open, new). Clears undo and selection, emits reset().
    void reset(Scene scene, const QString& path, std::vector<Problem> problems);
    void set_path(const QString& path); ///< after save; marks the undo stack clean

    /// Applies an edit as one undo entry named `text` (translated), or absorbs it into the open gesture.
    /// On an error nothing changes and the error is returned for display.
    Result<void> apply(const SceneEdit& edit, const QString& text);

    /// A gesture is a scope: edits applied until commit_gesture() become one undo entry; cancel_gesture() rolls all back.
    /// Use the RAII class Gesture (gesture.h) rather than these.
    void begin_gesture(const QString& text);
    void commit_gesture();
    void cancel_gesture();
    /// As the undo stack's, but ignored while a gesture is open (the mouse still holds what they would change).
    void undo();
    void redo();

Q_SIGNALS:
    void reset_done();                          ///< another scene altogether
    void edited(const atrium::SceneEdit& edit); ///< after scene() changed; the edit as applied (undo: the inverse)
    void gesture_finished();                    ///< committed or rolled back
    void path_changed();

private:
    friend class EditCommand;
    Result<SceneEdit>
    apply_now(const SceneEdit& edit); ///< applies, raises the revision, emits edited(); returns the inverse

    Scene scene_;
    std::uint64_t revision_ = 1;
    QUndoStack undo_;
    Selection selection_;
    QString path_;
    std::vector<Problem> problems_;
    int gesture_depth_ = 0;
    QString gesture_text_;
    GestureEdits gesture_; ///< edits of the open gesture
};

} // namespace atrium::ui
