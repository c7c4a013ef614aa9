// Opening, importing, saving and recovery: the work in the background, the questions without nested event loops.
#pragma once

#include "engine/scene/problems.h"
#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/document/recovery.h"

#include <QObject>

#include <functional>

class QWidget;

namespace atrium::ui {

/// UI thread only. Whatever fails, the open document stays as it was.
class FileController : public QObject {
    Q_OBJECT
public:
    FileController(Document& document, EngineLink& engine, Recovery& recovery, QWidget* window);

    void new_scene();
    void open_sample();
    void ask_and_open(); ///< with a file dialog
    void open(const QString& path);
    void ask_and_import();
    void import(const QString& path);
    void save(std::function<void(bool saved)> then = {}); ///< asks for a name where there is none
    void save_as(std::function<void(bool saved)> then = {});
    void save_to(const QString& path, std::function<void(bool saved)> then = {});
    void ask_and_export_gltf();
    void offer_recovery(); ///< after a crash; does nothing when nothing was left behind
    void open_recovered(const RecoveredFile& file);
    /// Runs `proceed` once nothing unsaved stands in its way: at once, after saving, or after "Discard".
    void when_saved(std::function<void()> proceed);
    void cancel_loading(); ///< the file that is being read is forgotten
    [[nodiscard]] bool busy() const { return loading_ || saving_; }
    [[nodiscard]] bool saving() const { return saving_; }

Q_SIGNALS:
    void busy_changed(const QString& what, bool can_cancel); ///< empty = nothing
    void opened();                                           ///< another document is shown
    void open_failed(const QString& why);                    ///< the document is the one before; the user was told
    void import_suggested(const atrium::ImportSuggestion& suggestion);
    void recent_changed();
    void message(const QString& text);

private:
    void start_open(const QString& path, std::function<void()> then);
    void show_error(const QString& title, const Error& error);
    void write(const QString& path, bool as_document, std::function<void(bool)> then);
    void ask_for_path(const QString& title, const QString& suggestion, const QString& filter, const QString& suffix,
                      std::function<void(const QString&)> then);
    void report_busy();

    Document& document_;
    EngineLink& engine_;
    Recovery& recovery_;
    QWidget* window_;
    std::uint64_t load_token_ = 0; ///< answers for older loads are dropped
    bool loading_ = false;
    bool saving_ = false;
    QString busy_text_;
};

} // namespace atrium::ui
