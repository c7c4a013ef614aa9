// The caustic inspector: what was decided about every surface that caustic light falls on and why, its textures, and what
// can be set by hand.
#pragma once

#include "ui/document/document.h"
#include "ui/document/engine_link.h"
#include "ui/panels/caustic_words.h"

#include <QWidget>

class QLabel;
class QLineEdit;
class QSplitter;
class QStackedWidget;
class QTableView;
class QTableWidget;

namespace atrium::ui {

class CausticFilter;
class CausticPreview;
class CausticSection;
class CausticTableModel;

/// UI thread only. Does nothing while it is not shown. Rows that are chosen here and the document's selection follow each
/// other; choosing an object that no caustics fall on leaves the rows alone.
class CausticPanel : public QWidget {
    Q_OBJECT
public:
    CausticPanel(Document& document, EngineLink& engine, QWidget* parent = nullptr);

    [[nodiscard]] QTableView* table() const { return table_; }
    [[nodiscard]] const CausticTableModel& model() const { return *model_; }
    [[nodiscard]] CausticPreview* preview() const { return preview_; }
    [[nodiscard]] int view_row(NodeId node) const;   ///< first one of the node as sorted and filtered; -1 = none
    [[nodiscard]] const CausticRow* current() const; ///< null where there is none
    void focus_table();                              ///< with a row, so that keys work at once

Q_SIGNALS:
    void current_changed();                            ///< another row, or the row's data
    void activated(const atrium::ui::CausticRow& row); ///< double click, Return: bring it into view
    void message(const QString& text);

protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void make_table();
    QWidget* make_details();
    void refresh(); ///< from the present solution
    void refresh_soon();
    [[nodiscard]] std::vector<NodeId> chosen_nodes() const; ///< of the rows that are chosen
    void on_table_selection();
    void on_document_selection();
    void show_details();
    void activate();

    Document& document_;
    EngineLink& engine_;
    CausticTableModel* model_ = nullptr;
    CausticFilter* filter_ = nullptr;
    QLineEdit* filter_field_ = nullptr;
    QLabel* summary_ = nullptr;
    QStackedWidget* pages_ = nullptr;
    QLabel* nothing_ = nullptr;
    QTableView* table_ = nullptr;
    QSplitter* splitter_ = nullptr;
    QSplitter* details_ = nullptr;
    QLabel* head_ = nullptr;
    QLabel* facts_ = nullptr;
    QTableWidget* boxes_ = nullptr;
    CausticSection* section_ = nullptr;
    CausticPreview* preview_ = nullptr;
    bool stale_ = true;
    bool queued_ = false;
    bool syncing_ = false;
};

} // namespace atrium::ui
