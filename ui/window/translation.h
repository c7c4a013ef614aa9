// The language of the window: which there are, and putting one on.
#pragma once

#include <QString>
#include <QStringList>

namespace atrium::ui {

/// Codes of the languages that the program has, English first: "en", "fr".
QStringList languages();
/// Its own name for itself, as "Français".
QString language_name(const QString& code);
/// The code that `wanted` (as Settings::language()) comes to; with nothing wanted, the first of the system's that there is.
QString chosen_language(const QString& wanted);
/// Texts of the program, and Qt's where they are installed. Before any window is made: what is shown stays as it is.
void install_language(const QString& code);

} // namespace atrium::ui
