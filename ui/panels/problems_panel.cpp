#include "ui/panels/problems_panel.h"

#include "ui/actions/icons.h"
#include "ui/document/background.h"
#include "ui/document/engine_text.h"

#include <QHeaderView>

#include <algorithm>

namespace atrium::ui {

namespace {
constexpr int kDelayMs = 400;
constexpr int kMaxRows = 1000;
} // namespace

ProblemsPanel::ProblemsPanel(Document& document, QWidget* parent) : QTreeWidget(parent), document_(document) {
    setObjectName(QStringLiteral("problems"));
    setAccessibleName(tr("Problems"));
    setHeaderLabels({tr("Where"), tr("What, and what to do")});
    setRootIsDecorated(false);
    setWordWrap(true);
    setTextElideMode(Qt::ElideRight);
    header()->resizeSection(0, 120);
    header()->setStretchLastSection(true);
    delay_.setSingleShot(true);
    delay_.setInterval(kDelayMs);
    connect(&delay_, &QTimer::timeout, this, &ProblemsPanel::check);
    connect(&document_, &Document::edited, this, [this] {
        if (!delay_.isActive()) {
            delay_.start();
        }
    });
    connect(&document_, &Document::reset_done, this, [this] {
        fill({});
        delay_.start();
    });
    connect(this, &QTreeWidget::itemActivated, this, [this](QTreeWidgetItem* item) {
        const NodeId id{item->data(0, Qt::UserRole).toUInt(), item->data(0, Qt::UserRole + 1).toUInt()};
        if (document_.scene().nodes.contains(id)) {
            document_.selection()->set({id});
            Q_EMIT activated_node(id);
        }
    });
}

void ProblemsPanel::check() {
    if (checking_ || document_.in_gesture()) {
        delay_.start();
        return;
    }
    checking_ = true;
    run_in_background(
        this, [scene = document_.scene()]() -> Result<std::vector<Problem>> { return find_problems(scene); },
        [this, revision = document_.revision()](const Result<std::vector<Problem>>& found) {
            checking_ = false;
            if (found) {
                fill(*found);
            }
            if (revision != document_.revision()) {
                delay_.start();
            }
        });
}

void ProblemsPanel::set_light_warning(const QString& text) {
    if (text != light_warning_) {
        light_warning_ = text;
        fill(std::vector<Problem>(found_));
    }
}

void ProblemsPanel::fill(const std::vector<Problem>& found) {
    found_ = found;
    std::vector<Problem> all = document_.problems();
    for (const Problem& problem : found) {
        if (std::find(all.begin(), all.end(), problem) == all.end()) {
            all.push_back(problem);
        }
    }
    std::stable_sort(all.begin(), all.end(), [](const Problem& a, const Problem& b) { return a.severity > b.severity; });
    clear();
    int errors = 0;
    int warnings = 0;
    QList<QTreeWidgetItem*> rows;
    for (const Problem& problem : all) {
        errors += problem.severity == Problem::Severity::Error ? 1 : 0;
        warnings += problem.severity == Problem::Severity::Warning ? 1 : 0;
        if (rows.size() >= kMaxRows) {
            continue;
        }
        QString text = engine_text(problem.what);
        if (!problem.hint.empty()) {
            text += QLatin1Char('\n') + engine_text(problem.hint);
        }
        auto* row = new QTreeWidgetItem({QString::fromStdString(problem.where), text});
        row->setIcon(0, tinted_icon(QLatin1StringView(severity_name(problem.severity))));
        row->setData(0, Qt::UserRole, problem.node.slot);
        row->setData(0, Qt::UserRole + 1, problem.node.generation);
        for (int column = 0; column < 2; ++column) {
            row->setToolTip(column, row->text(column));
        }
        rows.push_back(row);
    }
    if (!light_warning_.isEmpty()) {
        auto* row = new QTreeWidgetItem({tr("Light"), light_warning_});
        row->setIcon(0, tinted_icon(QStringLiteral("warning")));
        row->setToolTip(1, light_warning_);
        rows.push_back(row);
        ++warnings;
    }
    if (rows.isEmpty()) {
        auto* row = new QTreeWidgetItem({tr("No problems found")});
        row->setIcon(0, tinted_icon(QStringLiteral("ok")));
        row->setFlags(Qt::ItemIsEnabled);
        row->setFirstColumnSpanned(true);
        rows.push_back(row);
    }
    addTopLevelItems(rows);
    Q_EMIT count_changed(errors, warnings);
}

} // namespace atrium::ui
