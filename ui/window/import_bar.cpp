#include "ui/window/import_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>

#include <cmath>

namespace atrium::ui {

namespace {

QString unit_name(double scale) {
    static const std::pair<double, const char*> kUnits[] = {
        {0.001, QT_TRANSLATE_NOOP("atrium::ui::ImportBar", "millimetres")},
        {0.01, QT_TRANSLATE_NOOP("atrium::ui::ImportBar", "centimetres")},
        {0.0254, QT_TRANSLATE_NOOP("atrium::ui::ImportBar", "inches")},
        {0.3048, QT_TRANSLATE_NOOP("atrium::ui::ImportBar", "feet")}};
    for (const auto& [factor, name] : kUnits) {
        if (std::abs(scale / factor - 1) < 1e-6) {
            return ImportBar::tr(name);
        }
    }
    return ImportBar::tr("units of %1 m").arg(scale);
}

} // namespace

ImportBar::ImportBar(QWidget* parent) : QFrame(parent) {
    setObjectName(QStringLiteral("import_bar"));
    setFrameShape(QFrame::StyledPanel);
    setAutoFillBackground(true);
    setBackgroundRole(QPalette::AlternateBase);
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(10, 4, 10, 4);
    text_ = new QLabel;
    text_->setWordWrap(true);
    auto* fix = new QPushButton(tr("&Fix"));
    fix->setObjectName(QStringLiteral("import_fix"));
    fix->setToolTip(tr("Put everything into a group that corrects this; one step to undo"));
    auto* keep = new QPushButton(tr("&Keep"));
    keep->setObjectName(QStringLiteral("import_keep"));
    keep->setToolTip(tr("Leave the file as it is"));
    layout->addWidget(text_, 1);
    layout->addWidget(fix);
    layout->addWidget(keep);
    connect(fix, &QPushButton::clicked, this, [this] {
        hide();
        Q_EMIT accepted(suggestion_);
    });
    connect(keep, &QPushButton::clicked, this, &QWidget::hide);
    hide();
}

void ImportBar::offer(const ImportSuggestion& suggestion) {
    suggestion_ = suggestion;
    QString what;
    if (suggestion.unit_scale != 1.0 && suggestion.z_up) {
        what = tr("This file looks like %1, with +Z up.").arg(unit_name(suggestion.unit_scale));
    } else if (suggestion.z_up) {
        what = tr("This file looks like +Z is up in it.");
    } else {
        what = tr("This file looks like %1.").arg(unit_name(suggestion.unit_scale));
    }
    text_->setText(what);
    text_->setToolTip(QString::fromStdString(suggestion.why));
    show();
}

} // namespace atrium::ui
