// Light or dark: the colours of the whole program.
#pragma once

#include <QPalette>
#include <QString>

namespace atrium::ui {

enum class Appearance : std::uint8_t { System, Light, Dark };

/// "system", "light", "dark", as settings hold it; anything else is the system's.
Appearance appearance_of(const QString& name);
QString appearance_name(Appearance appearance);
/// The palette for Qt's Fusion style; System has none of its own.
QPalette appearance_palette(Appearance appearance);
/// Gives the application its colours, at once and in every window. Light and dark come with the Fusion style, since the
/// styles of desktops have colours of their own; System is what the program started with. UI thread.
void apply_appearance(Appearance appearance);

} // namespace atrium::ui
