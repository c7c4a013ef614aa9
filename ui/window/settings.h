// What the editor remembers between runs: window layout, recent files and the light shown. Nothing of the document.
#pragma once

#include "engine/layers/surface_layer.h"

#include <QByteArray>
#include <QString>
#include <QStringList>

namespace atrium::ui {

/// The shares by name, as "direct light, caustics".
QString shares_text(const LightShares& shares);

/// Thin face of QSettings. UI thread only.
class Settings {
public:
    [[nodiscard]] QByteArray geometry() const;
    [[nodiscard]] QByteArray layout() const; ///< QMainWindow::saveState of this version's docks
    void set_window(const QByteArray& geometry, const QByteArray& layout);
    [[nodiscard]] QStringList recent_files() const; ///< absolute paths, newest first, at most ten
    void add_recent(const QString& path);
    void remove_recent(const QString& path);
    [[nodiscard]] QString last_folder() const;
    void set_last_folder(const QString& folder);
    [[nodiscard]] QString photometry_folder() const; ///< where the last photometric file came from; else last_folder()
    void set_photometry_folder(const QString& folder);
    [[nodiscard]] LightShares light_shares() const; ///< what the view shows of the light; never nothing
    void set_light_shares(const LightShares& shares);
};

} // namespace atrium::ui
