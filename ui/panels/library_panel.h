// The dock with the library: sections, search, pictures to drag into the view or to put there with Enter.
#pragma once

#include "ui/document/library.h"

#include <QWidget>

#include <memory>

class QLabel;
class QLineEdit;
class QListView;
class QPushButton;
class QTabBar;

namespace atrium::ui {

class LibraryFilter;
class LibraryModel;

/// UI thread only.
class LibraryPanel : public QWidget {
    Q_OBJECT
public:
    explicit LibraryPanel(QWidget* parent = nullptr);
    void focus_search();
    void show_section(LibrarySection section);
    void set_folder(const QString& folder); ///< of the furniture; empty = none
    [[nodiscard]] QListView* view() const { return view_; }
    [[nodiscard]] QModelIndex view_index(const QString& key) const; ///< invalid while filtered out

Q_SIGNALS:
    /// Enter or a double click: put it into the view, or give the material to the selection.
    void chosen(std::shared_ptr<const atrium::ui::LibraryItem> item);
    void folder_wanted();
    void message(const QString& text);

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void choose(const QModelIndex& index);
    void update_page();

    LibraryModel* model_ = nullptr;
    LibraryFilter* filter_ = nullptr;
    QLineEdit* search_ = nullptr;
    QTabBar* sections_ = nullptr;
    QListView* view_ = nullptr;
    QLabel* note_ = nullptr;
    QPushButton* folder_button_ = nullptr;
    QString waiting_; ///< key of what is put into the view as soon as it is loaded
};

} // namespace atrium::ui
