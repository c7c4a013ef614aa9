// The editor's window: wires document, engine, viewport, panels and actions together.
#pragma once

#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/document/recovery.h"

#include <QMainWindow>

#include <functional>
#include <memory>

class QLabel;
class QMenu;
class QProgressBar;
class QStackedWidget;
class QToolButton;

namespace atrium::ui {

class Actions;
class CausticPanel;
class ConvergencePanel;
class EditController;
class FalseColorBar;
class OverlayController;
class FileController;
class ImportBar;
class LibraryPanel;
class NoticeBar;
class PhotometryController;
class PropertiesPanel;
class SceneTreePanel;
class StartPage;
class ViewportWidget;
enum class ActionId : std::uint8_t;

/// UI thread only. Tests reach the parts by the accessors and the actions by their object names.
class MainWindow : public QMainWindow {
    Q_OBJECT
public:
    /// `recovery_directory` empty = the user's own.
    explicit MainWindow(const QString& recovery_directory = {}, QWidget* parent = nullptr);
    ~MainWindow() override;

    [[nodiscard]] Document& document() { return document_; }
    [[nodiscard]] EngineLink& engine() { return *engine_; }
    [[nodiscard]] ViewportWidget& viewport() { return *viewport_; }
    [[nodiscard]] FileController& files() { return *files_; }
    [[nodiscard]] SceneTreePanel& tree() { return *tree_; }
    [[nodiscard]] LibraryPanel& library() { return *library_; }
    [[nodiscard]] PhotometryController& photometry() { return *photometry_; }
    [[nodiscard]] CausticPanel& caustics() { return *caustics_; }
    [[nodiscard]] FalseColorBar& false_color_bar() { return *false_color_bar_; }
    [[nodiscard]] ConvergencePanel& convergence() { return *convergence_; }
    [[nodiscard]] Recovery& recovery() { return *recovery_; }
    [[nodiscard]] QAction* action(ActionId id) const;

Q_SIGNALS:
    void snapping_steps_changed();

protected:
    void closeEvent(QCloseEvent* event) override;
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;
    void changeEvent(QEvent* event) override;

private:
    void raise_dock(const char* name);
    void make_docks();
    void make_menus();
    void make_tool_bar();
    void make_status_bar();
    void connect_files();
    void connect_notices();
    void connect_edit();
    void connect_view();
    void make_library();
    void make_snapping();
    void fill_snapping_menu(QMenu* menu);
    void fill_camera_menu(QMenu* menu);
    void look_through(NodeId camera);
    void step_camera(int step);
    void connect_editing();
    void connect_false_color();
    void connect_documents();
    void update_title();
    void update_actions();
    void update_page();
    void update_recent();
    void export_picture();
    dvec3 lamp_place(); ///< where a new lamp hangs; leaves the start page
    void drop_photometry(const QString& path, const QPointF& position);
    void say(const QString& text);
    void on(ActionId id, std::function<void()> slot);

    Document document_;
    std::unique_ptr<Recovery> recovery_;
    EngineLink* engine_ = nullptr;
    Actions* actions_ = nullptr;
    FileController* files_ = nullptr;
    EditController* edit_ = nullptr;
    PhotometryController* photometry_ = nullptr;
    ViewportWidget* viewport_ = nullptr;
    StartPage* start_ = nullptr;
    ImportBar* import_bar_ = nullptr;
    NoticeBar* autosave_notice_ = nullptr;
    NoticeBar* images_notice_ = nullptr;
    FalseColorBar* false_color_bar_ = nullptr;
    OverlayController* overlays_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    SceneTreePanel* tree_ = nullptr;
    PropertiesPanel* properties_ = nullptr;
    LibraryPanel* library_ = nullptr;
    QToolButton* snap_badge_ = nullptr;
    NodeId camera_; ///< looked through last
    CausticPanel* caustics_ = nullptr;
    ConvergencePanel* convergence_ = nullptr;
    QMenu* recent_menu_ = nullptr;
    QMenu* docks_menu_ = nullptr;
    QLabel* busy_text_ = nullptr;
    QProgressBar* busy_bar_ = nullptr;
    QToolButton* busy_cancel_ = nullptr;
    QToolButton* problems_badge_ = nullptr;
    bool started_ = false; ///< something was opened or made: the start page stays away
    bool closing_ = false;
};

} // namespace atrium::ui
