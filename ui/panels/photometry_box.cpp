#include "ui/panels/photometry_box.h"

#include "engine/scene/photometric_web.h"
#include "ui/panels/polar_diagram.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPushButton>
#include <QVBoxLayout>

#include <algorithm>

namespace atrium::ui {

namespace {

QString beam_text(const PhotometricWeb& web) {
    double across = web.beam_angle(0.0), along = web.beam_angle(90.0);
    if (across < 0.5 || along < 0.5) {
        across = along = std::max(across, along); // aimed to one side: no plane but that one is as bright
    }
    const auto degrees = [](double angle) { return QLocale().toString(angle, 'f', 0); };
    if (across >= 359.5) {
        return {};
    }
    return degrees(across) == degrees(along) ? PhotometryBox::tr("beam %1°").arg(degrees(across))
                                             : PhotometryBox::tr("beam %1° × %2°").arg(degrees(across), degrees(along));
}

} // namespace

QString photometry_summary(const PhotometricWeb& web) {
    QStringList parts;
    if (!web.data().manufacturer.empty()) {
        const QString maker = QString::fromStdString(web.data().manufacturer).simplified();
        constexpr qsizetype kMost = 40;
        parts << (maker.size() > kMost ? maker.left(kMost).trimmed() + QChar(0x2026) : maker);
    }
    parts << PhotometryBox::tr("%1 lm").arg(QLocale().toString(web.flux(), 'f', web.flux() < 100.0 ? 1 : 0));
    if (const QString beam = beam_text(web); !beam.isEmpty()) {
        parts << beam;
    }
    if (web.data().watts > 0.0) {
        parts << PhotometryBox::tr("%1 W").arg(QLocale().toString(web.data().watts, 'g', 4));
    }
    return parts.join(PhotometryBox::tr(", "));
}

PhotometryBox::PhotometryBox(QWidget* parent) : QWidget(parent) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(5);
    buttons_ = new QWidget;
    auto* row = new QHBoxLayout(buttons_);
    row->setContentsMargins(0, 0, 0, 0);
    choose_ = new QPushButton(tr("Choose IES File..."));
    choose_->setObjectName(QStringLiteral("photometry_choose"));
    choose_->setToolTip(tr("Let the lamp shine as its maker measured it. An IES file can also be dropped onto a lamp"));
    remove_ = new QPushButton(tr("Remove"));
    remove_->setObjectName(QStringLiteral("photometry_remove"));
    remove_->setToolTip(tr("Shine without a file, with the same flux"));
    row->addWidget(choose_, 1);
    row->addWidget(remove_);
    words_ = new QLabel;
    words_->setObjectName(QStringLiteral("photometry_words"));
    words_->setWordWrap(true);
    words_->setTextFormat(Qt::PlainText);
    words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(words_);
    diagram_ = new PolarDiagram;
    diagram_->setObjectName(QStringLiteral("photometry_diagram"));
    layout->addWidget(diagram_);
    connect(choose_, &QPushButton::clicked, this, &PhotometryBox::choose);
    connect(remove_, &QPushButton::clicked, this, &PhotometryBox::remove);
}

void PhotometryBox::set(const std::vector<Photometry>& of_lamps) {
    const bool any = std::any_of(of_lamps.begin(), of_lamps.end(), [](const Photometry& p) { return bool(p); });
    const bool same =
        any && std::all_of(of_lamps.begin(), of_lamps.end(), [&](const Photometry& p) { return p == of_lamps.front(); });
    remove_->setVisible(any);
    setVisible(any);
    diagram_->setVisible(same);
    if (same) {
        const PhotometricWeb& web = *of_lamps.front().web;
        QString text = QString::fromStdString(web.data().file_name);
        for (const std::string* line : {&web.data().luminaire, &web.data().catalog}) {
            if (const QString more = QString::fromStdString(*line).simplified(); !more.isEmpty()) {
                constexpr qsizetype kMost = 120;
                text += QLatin1Char('\n') + (more.size() > kMost ? more.left(kMost) + QChar(0x2026) : more);
                break;
            }
        }
        words_->setText(text + QLatin1Char('\n') + photometry_summary(web));
        diagram_->set_photometry(of_lamps.front());
    } else {
        words_->setText(any ? tr("Different files") : QString());
        diagram_->set_photometry({});
    }
}

} // namespace atrium::ui
