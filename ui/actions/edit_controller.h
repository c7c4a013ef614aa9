// What the Edit and Add menus do to the selection.
#pragma once

#include "engine/view/still.h"
#include "ui/document/document.h"
#include "ui/document/scene_commands.h"

#include <QObject>

namespace atrium::ui {

/// UI thread only. Every slot is one undo entry; with nothing selected it says so instead.
class EditController : public QObject {
    Q_OBJECT
public:
    explicit EditController(Document& document, QObject* parent = nullptr);

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
    Document& document_;
};

} // namespace atrium::ui
