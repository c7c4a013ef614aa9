// Icons drawn in the palette's text colour, so that they are seen on light and on dark.
#pragma once

#include <QIcon>
#include <QString>

namespace atrium::ui {

/// Icon :/icons/NAME.svg with "currentColor" replaced by the application palette's text colour; empty for unknown names.
QIcon tinted_icon(const QString& name);

} // namespace atrium::ui
