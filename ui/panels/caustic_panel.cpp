#include "ui/panels/caustic_panel.h"

#include "ui/panels/caustic_preview.h"
#include "ui/panels/caustic_section.h"
#include "ui/panels/caustic_table_model.h"

#include <QHeaderView>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QScrollArea>
#include <QSplitter>
#include <QStackedWidget>
#include <QTableView>
#include <QTableWidget>
#include <QVBoxLayout>

#include <algorithm>
#include <unordered_set>

namespace atrium::ui {

namespace {

QString fact(const QString& name, const QString& value) {
    return value.isEmpty() ? QString()
                           : QStringLiteral("<tr><td style=\"padding-right:10px\"><b>%1</b></td><td>%2</td></tr>")
                                 .arg(name.toHtmlEscaped(), value.toHtmlEscaped());
}

} // namespace

CausticPanel::CausticPanel(Document& document, EngineLink& engine, QWidget* parent)
    : QWidget(parent), document_(document), engine_(engine) {
    setObjectName(QStringLiteral("caustics"));
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(6, 4, 6, 6);
    layout->setSpacing(4);
    auto* top = new QHBoxLayout;
    filter_field_ = new QLineEdit;
    filter_field_->setObjectName(QStringLiteral("caustic_filter"));
    filter_field_->setPlaceholderText(tr("Filter surfaces"));
    filter_field_->setAccessibleName(tr("Filter surfaces by name, decision or reason"));
    filter_field_->setClearButtonEnabled(true);
    filter_field_->setMaximumWidth(220);
    summary_ = new QLabel;
    summary_->setObjectName(QStringLiteral("caustic_summary"));
    summary_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred); // its text must not widen the dock
    top->addWidget(filter_field_);
    top->addWidget(summary_, 1);
    layout->addLayout(top);
    make_table();
    splitter_ = new QSplitter(Qt::Horizontal);
    splitter_->setChildrenCollapsible(false);
    splitter_->addWidget(table_);
    splitter_->addWidget(make_details());
    splitter_->setStretchFactor(0, 3);
    splitter_->setStretchFactor(1, 2);
    splitter_->setSizes({520, 470}); // a dock as wide as a window of usual size leaves
    nothing_ = new QLabel;
    nothing_->setObjectName(QStringLiteral("caustic_nothing"));
    nothing_->setAlignment(Qt::AlignCenter);
    nothing_->setWordWrap(true);
    nothing_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    pages_ = new QStackedWidget;
    pages_->addWidget(splitter_);
    pages_->addWidget(nothing_);
    layout->addWidget(pages_, 1);

    connect(filter_field_, &QLineEdit::textChanged, this, [this](const QString& text) {
        filter_->set_text(text);
        on_document_selection();
    });
    connect(&engine_, &EngineLink::solution_changed, this, &CausticPanel::refresh_soon);
    connect(&document_, &Document::edited, this, &CausticPanel::refresh_soon); // names and what is set by hand
    connect(&document_, &Document::reset_done, this, [this] {
        model_->clear(); // ids mean other things now
        refresh_soon();
    });
    connect(document_.selection(), &Selection::changed, this, &CausticPanel::on_document_selection);
    refresh();
}

void CausticPanel::make_table() {
    model_ = new CausticTableModel(this);
    filter_ = new CausticFilter(this);
    filter_->setSourceModel(model_);
    table_ = new QTableView;
    table_->setObjectName(QStringLiteral("caustic_table"));
    table_->setAccessibleName(tr("Surfaces that caustics fall on"));
    table_->setModel(filter_);
    table_->setSelectionBehavior(QAbstractItemView::SelectRows);
    table_->setSelectionMode(QAbstractItemView::ExtendedSelection);
    table_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    table_->setAlternatingRowColors(true);
    table_->setShowGrid(false);
    table_->setWordWrap(false);
    table_->setTabKeyNavigation(false); // Tab leaves the table
    table_->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
    table_->setMinimumSize(220, 90);
    table_->verticalHeader()->hide();
    table_->verticalHeader()->setDefaultSectionSize(table_->fontMetrics().height() + 8);
    table_->verticalHeader()->setSectionResizeMode(QHeaderView::Fixed);
    table_->horizontalHeader()->setHighlightSections(false);
    table_->horizontalHeader()->setSectionsMovable(true);
    const int letter = table_->fontMetrics().averageCharWidth();
    const std::pair<int, int> widths[] = {
        {CausticTableModel::Surface, 22},    {CausticTableModel::ShownAs, 12}, {CausticTableModel::Texel, 8},
        {CausticTableModel::Boxes, 6},       {CausticTableModel::Coverage, 9}, {CausticTableModel::Memory, 9},
        {CausticTableModel::InTextures, 13}, {CausticTableModel::OnMesh, 9},   {CausticTableModel::Particles, 9},
        {CausticTableModel::Kernel, 8},      {CausticTableModel::Reason, 60},  {CausticTableModel::TexelReason, 32}};
    for (const auto& [column, letters] : widths) {
        table_->horizontalHeader()->resizeSection(column, letters * letter + 12);
    }
    table_->setSortingEnabled(true);
    table_->sortByColumn(CausticTableModel::InTextures, Qt::DescendingOrder);
    table_->installEventFilter(this);
    connect(table_->selectionModel(), &QItemSelectionModel::selectionChanged, this, &CausticPanel::on_table_selection);
    connect(table_->selectionModel(), &QItemSelectionModel::currentRowChanged, this, &CausticPanel::show_details);
    connect(table_, &QTableView::doubleClicked, this, &CausticPanel::activate);
}

QWidget* CausticPanel::make_details() {
    for (QLabel** label : {&head_, &facts_}) {
        *label = new QLabel;
        (*label)->setTextFormat(Qt::RichText);
        (*label)->setWordWrap(true);
        (*label)->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
        (*label)->setAlignment(Qt::AlignLeft | Qt::AlignTop);
    }
    head_->setObjectName(QStringLiteral("caustic_head"));
    facts_->setObjectName(QStringLiteral("caustic_facts"));
    section_ = new CausticSection(document_);
    connect(section_, &Section::message, this, &CausticPanel::message);
    boxes_ = new QTableWidget(0, 5);
    boxes_->setObjectName(QStringLiteral("caustic_boxes"));
    boxes_->setAccessibleName(tr("Restriction boxes"));
    boxes_->setHorizontalHeaderLabels({tr("u"), tr("v"), tr("Across"), tr("Up"), tr("Texels")});
    boxes_->setEditTriggers(QAbstractItemView::NoEditTriggers);
    boxes_->setSelectionBehavior(QAbstractItemView::SelectRows);
    boxes_->setSelectionMode(QAbstractItemView::SingleSelection);
    boxes_->setTabKeyNavigation(false);
    boxes_->setShowGrid(false);
    boxes_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    boxes_->verticalHeader()->setDefaultSectionSize(boxes_->fontMetrics().height() + 6);
    boxes_->setMinimumHeight(96);
    auto* column = new QWidget;
    auto* layout = new QVBoxLayout(column);
    layout->setContentsMargins(4, 0, 4, 0);
    layout->setSpacing(6);
    layout->addWidget(head_);
    layout->addWidget(section_);
    layout->addWidget(facts_);
    layout->addWidget(boxes_);
    layout->addStretch(1);
    auto* scroll = new QScrollArea;
    scroll->setWidget(column);
    scroll->setWidgetResizable(true);
    scroll->setFrameShape(QFrame::NoFrame);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setMinimumWidth(250);
    preview_ = new CausticPreview;
    connect(boxes_, &QTableWidget::currentCellChanged, this, [this](int row) {
        if (!syncing_ && row >= 0) {
            preview_->show_box(row);
        }
    });
    details_ = new QSplitter(Qt::Horizontal);
    details_->setChildrenCollapsible(false);
    details_->addWidget(scroll);
    details_->addWidget(preview_);
    details_->setStretchFactor(0, 1);
    details_->setStretchFactor(1, 1);
    details_->setSizes({260, 210});
    return details_;
}

void CausticPanel::resizeEvent(QResizeEvent* event) {
    QWidget::resizeEvent(event);
    // Beside the table where there is width, below it in a narrow dock.
    const bool wide = width() > 820;
    splitter_->setOrientation(wide ? Qt::Horizontal : Qt::Vertical);
    details_->setOrientation(wide || width() > 520 ? Qt::Horizontal : Qt::Vertical);
}

void CausticPanel::showEvent(QShowEvent* event) {
    QWidget::showEvent(event);
    if (stale_) {
        refresh();
    }
}

bool CausticPanel::eventFilter(QObject* watched, QEvent* event) {
    if (watched == table_ && event->type() == QEvent::KeyPress) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        if (key == Qt::Key_Return || key == Qt::Key_Enter) {
            activate();
            return true;
        }
    }
    return QWidget::eventFilter(watched, event);
}

void CausticPanel::refresh_soon() {
    stale_ = true;
    if (!queued_ && isVisible()) {
        queued_ = true;
        QMetaObject::invokeMethod(
            this,
            [this] {
                queued_ = false;
                refresh();
            },
            Qt::QueuedConnection);
    }
}

void CausticPanel::refresh() {
    if (!isVisible()) {
        return; // showEvent() comes back here
    }
    stale_ = false;
    const std::shared_ptr<const Solution> solution = engine_.solution();
    const QString nothing = caustic_nothing_text(solution.get());
    nothing_->setText(nothing);
    pages_->setCurrentIndex(nothing.isEmpty() ? 0 : 1);
    summary_->setText(nothing.isEmpty() ? caustic_summary_text(*solution) : QString());
    summary_->setToolTip(summary_->text());
    const bool were_none = model_->rowCount() == 0;
    // Rows go and come without the document hearing that they were deselected.
    syncing_ = true;
    model_->set_rows(solution ? caustic_rows(document_.scene(), *solution) : std::vector<CausticRow>());
    syncing_ = false;
    if (were_none && model_->rowCount() > 0) {
        on_document_selection();
    }
    show_details();
}

const CausticRow* CausticPanel::current() const {
    const QModelIndex index = filter_->mapToSource(table_->currentIndex());
    return index.isValid() && index.row() < model_->rowCount() ? &model_->row(index.row()) : nullptr;
}

int CausticPanel::view_row(NodeId node) const {
    for (int i = 0; i < filter_->rowCount(); ++i) {
        if (model_->row(filter_->mapToSource(filter_->index(i, 0)).row()).record.node == node) {
            return i;
        }
    }
    return -1;
}

void CausticPanel::focus_table() {
    table_->setFocus(Qt::ShortcutFocusReason);
    if (!table_->currentIndex().isValid() && filter_->rowCount() > 0) {
        table_->selectRow(0);
    }
}

void CausticPanel::activate() {
    if (const CausticRow* row = current()) {
        Q_EMIT activated(*row);
    }
}

std::vector<NodeId> CausticPanel::chosen_nodes() const {
    std::vector<NodeId> nodes;
    std::unordered_set<NodeId> seen;
    const QModelIndexList rows = table_->selectionModel()->selectedRows();
    for (const QModelIndex& index : rows) {
        const NodeId node = model_->row(filter_->mapToSource(index).row()).record.node;
        if (seen.insert(node).second) {
            nodes.push_back(node);
        }
    }
    return nodes;
}

void CausticPanel::on_table_selection() {
    show_details();
    if (syncing_) {
        return;
    }
    syncing_ = true;
    std::vector<NodeId> nodes = chosen_nodes();
    std::erase_if(nodes, [this](NodeId id) { return !document_.scene().nodes.contains(id); });
    if (!nodes.empty()) {
        document_.selection()->set(std::move(nodes));
    }
    syncing_ = false;
}

void CausticPanel::on_document_selection() {
    if (syncing_ || !isVisible()) {
        return;
    }
    syncing_ = true;
    const std::vector<NodeId>& nodes = document_.selection()->nodes();
    const std::unordered_set<NodeId> wanted(nodes.begin(), nodes.end());
    QItemSelection selection;
    QModelIndex first;
    for (int i = 0; i < filter_->rowCount(); ++i) {
        const QModelIndex index = filter_->index(i, 0);
        if (wanted.contains(model_->row(filter_->mapToSource(index).row()).record.node)) {
            selection.select(index, index.siblingAtColumn(CausticTableModel::ColumnCount - 1));
            first = first.isValid() ? first : index;
        }
    }
    if (first.isValid()) {
        const QModelIndex now = table_->currentIndex().siblingAtColumn(0);
        table_->selectionModel()->select(selection, QItemSelectionModel::ClearAndSelect);
        if (!now.isValid() || !selection.contains(now)) {
            table_->selectionModel()->setCurrentIndex(first, QItemSelectionModel::NoUpdate);
            table_->scrollTo(first);
        }
    }
    syncing_ = false;
    show_details();
}

void CausticPanel::show_details() {
    const CausticRow* row = current();
    section_->set_targets(chosen_nodes(), row);
    preview_->show_row(row != nullptr ? std::optional(*row) : std::nullopt);
    if (row == nullptr) {
        head_->setText(tr("Choose a surface in the table."));
        facts_->clear();
        boxes_->setVisible(false);
        Q_EMIT current_changed();
        return;
    }
    const CausticRecord& r = row->record;
    QString text = QStringLiteral("<table>");
    head_->setText(QStringLiteral("<b>%1</b>: %2<br>%3")
                       .arg(row->name.toHtmlEscaped(), caustic_decision_text(*row).toHtmlEscaped(),
                            caustic_reason_text(*row).toHtmlEscaped()));
    text += fact(tr("Piece"), r.extent.x > 0.0F
                                  ? tr("%1 x %2").arg(length_text(double(r.extent.x)), length_text(double(r.extent.y)))
                                  : QString());
    text += fact(tr("Particles"), tr("%1, contrast %2").arg(count_text(r.particles)).arg(double(r.contrast), 0, 'f', 2));
    if (row->has_texture()) {
        text += fact(tr("Texels"), tr("%1 (%2)").arg(length_text(row->texel()), caustic_sizing_text(*row)));
        text += fact(tr("Kernels"), caustic_kernel_text(*row));
        text += fact(
            tr("Boxes"),
            tr("%1, covering %2; %3").arg(count_text(r.boxes.size()), share_text(row->coverage()), memory_text(r.bytes)));
    }
    text +=
        fact(tr("Light"), tr("%1 in textures, %2 on the mesh").arg(lumen_text(r.power_texture), lumen_text(r.power_mesh)));
    facts_->setText(text + QStringLiteral("</table>"));
    syncing_ = true;
    boxes_->setVisible(!r.boxes.empty());
    boxes_->setRowCount(int(r.boxes.size()));
    for (int i = 0; i < int(r.boxes.size()); ++i) {
        const vec4& b = r.boxes[std::size_t(i)];
        const QLocale locale;
        const auto range = [&](float from, float to, float scale, int decimals) {
            return tr("%1 to %2")
                .arg(locale.toString(double(from * scale), 'f', decimals),
                     locale.toString(double(to * scale), 'f', decimals));
        };
        const bool known = std::size_t(i) < row->textures.size();
        const QString texels =
            known ? tr("%1 x %2").arg(row->textures[std::size_t(i)]->width).arg(row->textures[std::size_t(i)]->height)
                  : QString();
        const QString cells[] = {range(b.x, b.z, 1.0F, 3), range(b.y, b.w, 1.0F, 3),
                                 tr("%1 m").arg(range(b.x, b.z, r.extent.x, 3)),
                                 tr("%1 m").arg(range(b.y, b.w, r.extent.y, 3)), texels};
        for (int column = 0; column < 5; ++column) {
            auto* item = boxes_->item(i, column);
            if (item == nullptr) {
                item = new QTableWidgetItem;
                boxes_->setItem(i, column, item);
            }
            item->setText(cells[column]);
            item->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
        }
    }
    syncing_ = false;
    Q_EMIT current_changed();
}

} // namespace atrium::ui
