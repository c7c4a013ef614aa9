// Work that was not saved, beside the file that was: dates, pictures and what differs, to choose between them.
#pragma once

#include "ui/document/recovery.h"

#include <QDialog>

#include <memory>

class QComboBox;
class QLabel;
class QPushButton;

namespace atrium::ui {

/// What one scene has that another has not, by name and placement.
struct SceneDifference {
    QStringList added;
    QStringList removed;
    QStringList changed; ///< moved, or with other shapes, materials or light
    [[nodiscard]] bool any() const { return !added.isEmpty() || !removed.isEmpty() || !changed.isEmpty(); }
};
/// From `saved` to `recovered`. Nodes of the same name are matched in tree order. Any thread.
SceneDifference scene_difference(const Scene& saved, const Scene& recovered);

/// Files are read and drawn off the UI thread. UI thread only.
class RecoveryDialog : public QDialog {
    Q_OBJECT
public:
    /// At least one file; `after_crash`: offered at the start, not asked for.
    RecoveryDialog(std::vector<RecoveredFile> files, bool after_crash, QWidget* parent);

    /// Whether both pictures stand, for tests.
    [[nodiscard]] bool drawn() const { return drawn_; }

Q_SIGNALS:
    void recover(const atrium::ui::RecoveredFile& file);
    void open_saved(const QString& path);

private:
    void show_file(int index);
    void remove_shown();

    std::vector<RecoveredFile> files_;
    int shown_ = 0;
    int token_ = 0; ///< answers about another file are dropped
    bool drawn_ = false;
    QComboBox* choice_ = nullptr;
    QLabel* intro_ = nullptr;
    QLabel* saved_caption_ = nullptr;
    QLabel* saved_picture_ = nullptr;
    QLabel* recovered_caption_ = nullptr;
    QLabel* recovered_picture_ = nullptr;
    QLabel* summary_ = nullptr;
    QPushButton* recover_button_ = nullptr;
    QPushButton* saved_button_ = nullptr;
};

} // namespace atrium::ui
