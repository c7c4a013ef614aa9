// What the Edit and Add menus do to the selection.
#pragma once

#include "engine/view/still.h"
#include "ui/document/document.h"
#include "ui/document/library.h"
#include "ui/document/scene_commands.h"

#include <QObject>

#include <functional>
#include <memory>

namespace atrium::ui {

/// UI thread only. Every slot is one undo entry; with nothing selected it says so instead.
class EditController : public QObject {
    Q_OBJECT
public:
    explicit EditController(Document& document, QObject* parent = nullptr);

    void copy(); ///< onto the clipboard; no undo entry
    void cut();
    /// Pastes nodes: under `place`, which tells where an object with these bounds (about its own middle of the base) goes,
    /// or without it where they were. Data of other windows are read in the background first.
    using Placement = std::function<dmat4(const DBox3& bounds)>;
    void paste(const Placement& place);
    void copy_material(); ///< of the active object's first part
    void paste_material();
    /// Gives a material of the library to the selection.
    void assign(const LibraryItem& material);
    void toggle_lock();
    void duplicate();
    void remove();
    void hide();
    void show_all();
    void group();
    void select_all();
    void select_none();
    void add(NewObject kind, const dvec3& at);
    void add_camera_here(const ViewCamera& camera);
    /// Answers the import suggestion: wraps the roots in a group that scales and turns.
    void fix_import(const ImportSuggestion& suggestion);
    void add_daylight(); ///< a sun and a sky as one undo entry

Q_SIGNALS:
    void message(const QString& text);

private:
    bool apply(const SceneEdit& edit, const QString& text);
    bool nothing_selected();
    /// Calls `use` with what is on the clipboard of this kind, at once or when it is read.
    void from_clipboard(bool material, std::function<void(const Scene&)> use);
    Document& document_;
};

} // namespace atrium::ui
