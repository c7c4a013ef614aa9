#include "ui/window/preferences_dialog.h"

#include "engine/solver/memory_budget.h"
#include "ui/window/settings.h"
#include "ui/window/translation.h"

#include <QComboBox>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QLabel>
#include <QLocale>
#include <QVBoxLayout>

namespace atrium::ui {

PreferencesDialog::PreferencesDialog(QWidget* parent) : QDialog(parent) {
    setObjectName(QStringLiteral("preferences_dialog"));
    setWindowTitle(tr("Preferences"));
    auto* layout = new QVBoxLayout(this);
    auto* form = new QFormLayout;
    const Settings settings;
    language_ = new QComboBox;
    language_->setObjectName(QStringLiteral("language"));
    language_->addItem(tr("As the system (%1)").arg(language_name(chosen_language({}))), QString());
    for (const QString& code : languages()) {
        language_->addItem(language_name(code), code);
    }
    language_->setCurrentIndex(std::max(0, language_->findData(settings.language())));
    form->addRow(tr("&Language:"), language_);
    appearance_ = new QComboBox;
    appearance_->setObjectName(QStringLiteral("appearance"));
    for (const auto& [text, value] : {std::pair{tr("As the system"), Appearance::System},
                                      {tr("Light"), Appearance::Light},
                                      {tr("Dark"), Appearance::Dark}}) {
        appearance_->addItem(text, appearance_name(value));
    }
    appearance_->setCurrentIndex(appearance_->findData(appearance_name(settings.appearance())));
    form->addRow(tr("&Colours:"), appearance_);
    autosave_ = new QComboBox;
    autosave_->setObjectName(QStringLiteral("autosave"));
    for (const int seconds : {10, 30, 60, 120}) {
        autosave_->addItem(seconds < 60 ? tr("%n second(s) after a change", nullptr, seconds)
                                        : tr("%n minute(s) after a change", nullptr, seconds / 60),
                           seconds);
    }
    autosave_->setCurrentIndex(std::max(0, autosave_->findData(settings.autosave_seconds())));
    form->addRow(tr("Keep &unsaved work:"), autosave_);
    memory_ = new QComboBox;
    memory_->setObjectName(QStringLiteral("memory"));
    memory_->setToolTip(tr("Light that would take more gets coarser. The Light panel says so."));
    const QLocale locale;
    const auto size_text = [&](qint64 mib) { return locale.formattedDataSize(mib << 20, mib < 1024 ? 0 : 1); };
    const auto half = qint64(default_memory_budget() >> 20U);
    memory_->addItem(tr("Half of this computer's (%1)").arg(size_text(half)), 0);
    for (int mib = 256; mib < 2 * half; mib *= 2) {
        memory_->addItem(size_text(mib), mib);
    }
    if (const int mib = settings.memory_mib(); memory_->findData(mib) < 0) { // set by hand, or on a larger machine
        memory_->addItem(size_text(mib), mib);
    }
    memory_->setCurrentIndex(memory_->findData(settings.memory_mib()));
    form->addRow(tr("&Memory for light:"), memory_);
    layout->addLayout(form);
    auto* hint = new QLabel(tr("Another language shows when Atrium is started again."));
    hint->setEnabled(false);
    layout->addWidget(hint);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Ok | QDialogButtonBox::Cancel);
    layout->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::accepted, this, &PreferencesDialog::store);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

void PreferencesDialog::store() {
    Settings settings;
    settings.set_language(language_->currentData().toString());
    settings.set_appearance(appearance_of(appearance_->currentData().toString()));
    apply_appearance(settings.appearance());
    settings.set_autosave_seconds(autosave_->currentData().toInt());
    settings.set_memory_mib(memory_->currentData().toInt());
    accept();
    Q_EMIT stored();
}

} // namespace atrium::ui
