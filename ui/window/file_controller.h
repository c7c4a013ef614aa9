// Opening, importing, saving and recovery: the work in the background, the questions without nested event loops.
#pragma once

#include "engine/scene/problems.h"
#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/document/file_guard.h"
#include "ui/document/recovery.h"

#include <QMessageBox>
#include <QObject>

#include <functional>
#include <optional>

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
    void revert();         ///< to the saved file; what is unsaved is put aside first
    void offer_recovery(); ///< after a crash; does nothing when nothing was left behind
    void show_recovered(); ///< everything that was recovered or given up
    void open_recovered(const RecoveredFile& file);
    /// Runs `proceed` once nothing unsaved stands in its way: at once, after saving, or after "Discard".
    void when_saved(std::function<void()> proceed);
    void cancel_loading(); ///< the file that is being read is forgotten
    void ask_and_find_textures();
    void find_textures(const QString& folder); ///< looks there and below for images that are missing: one undo entry
    [[nodiscard]] bool busy() const { return loading_ || saving_ || searching_; }
    [[nodiscard]] bool read_only() const { return hold_.read_only; } ///< saving asks for another name
    [[nodiscard]] bool saving() const { return saving_; }

Q_SIGNALS:
    void busy_changed(const QString& what, bool can_cancel); ///< empty = nothing
    void opened();                                           ///< another document is shown
    void open_failed(const QString& why);                    ///< the document is the one before; the user was told
    void import_suggested(const atrium::ImportSuggestion& suggestion);
    void textures_missing(int count);
    void read_only_changed();
    void saved();
    void recent_changed();
    void message(const QString& text);

private:
    /// What is known of the file that the document is saved to.
    struct FileHold {
        std::shared_ptr<ProjectLock> lock; ///< null: none was needed
        FileStamp stamp;                   ///< as it was read or written last
        bool read_only = false;
    };
    struct OpenRequest {
        QString path;
        QString original = {}; ///< the document that a recovered file belongs to
        bool read_only = false;
        bool ignore_lock = false;
        std::function<void()> then = {}; ///< instead of remembering the file
        [[nodiscard]] const QString& saved_to() const { return then ? original : path; }
    };
    /// Overwrite: whatever somebody else wrote there meanwhile.
    enum class Writing : std::uint8_t { Document, Overwrite, Export };

    void start_open(OpenRequest request);
    void replace(Scene scene, const QString& path, std::vector<Problem> problems, const FileHold& hold);
    void ask_about_lock(const OpenRequest& request, const QString& holder);
    void ask_about_change(const QString& path, std::function<void(bool)> then);
    void ask_after_failure(const QString& path, const Error& error, std::function<void(bool)> then);
    void show_recovery(std::vector<RecoveredFile> files, bool after_crash);
    [[nodiscard]] QMessageBox* make_box(QMessageBox::Icon icon, const char* name, const QString& title, const QString& text,
                                        const QString& more);
    static QString error_text(const Error& error);
    [[nodiscard]] QString document_name() const;
    void show_error(const QString& title, const Error& error);
    void write(const QString& path, Writing writing, std::function<void(bool)> then);
    void ask_for_path(const QString& title, const QString& suggestion, const QString& filter, const QString& suffix,
                      std::function<void(const QString&)> then);
    void report_busy();

    Document& document_;
    EngineLink& engine_;
    Recovery& recovery_;
    QWidget* window_;
    FileHold hold_;
    std::optional<RecoveredFile> recovered_; ///< shown and not saved yet
    std::uint64_t load_token_ = 0;           ///< answers for older loads are dropped
    bool loading_ = false;
    bool saving_ = false;
    bool searching_ = false;
    QString busy_text_;
};

} // namespace atrium::ui
