// What the editor remembers between runs: window layout, recent files and the light shown. Nothing of the document.
#pragma once

#include "engine/layers/surface_layer.h"
#include "engine/view/false_color.h"
#include "ui/tools/snapping.h"
#include "ui/window/appearance.h"

#include <QByteArray>
#include <QString>
#include <QStringList>

#include <optional>

namespace atrium::ui {

/// The shares by name, as "direct light, caustics".
QString shares_text(const LightShares& shares);

/// How one quantity of light is turned into colours.
struct ScaleChoice {
    bool logarithmic = true; ///< sun and shade, and 100-200-300-500 lx, are told apart on the same scale
    bool automatic = true;   ///< the range follows the scene's light
    double minimum = 0;      ///< of a range set by hand, lux or cd/m2
    double maximum = 500;
};

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
    [[nodiscard]] Snapping snapping() const;
    void set_snapping(const Snapping& snapping);
    [[nodiscard]] QString furniture_folder() const; ///< of the library; empty = none chosen
    void set_furniture_folder(const QString& folder);
    [[nodiscard]] std::optional<LightQuantity> false_color() const; ///< none: the picture
    void set_false_color(std::optional<LightQuantity> quantity);
    [[nodiscard]] ScaleChoice scale_choice(LightQuantity quantity) const;
    void set_scale_choice(LightQuantity quantity, const ScaleChoice& choice);
    /// "fr", "en"; empty = that of the system.
    [[nodiscard]] QString language() const;
    void set_language(const QString& language);
    /// Light or dark.
    [[nodiscard]] Appearance appearance() const;
    void set_appearance(Appearance appearance);
    [[nodiscard]] int autosave_seconds() const; ///< after a change, 10 to 120
    void set_autosave_seconds(int seconds);
    [[nodiscard]] int memory_mib() const; ///< that light may take; 0 = half of the machine's
    void set_memory_mib(int mib);
    [[nodiscard]] bool contours() const;
    void set_contours(bool on);
};

} // namespace atrium::ui
