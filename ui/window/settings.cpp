#include "ui/window/settings.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>

#include <algorithm>

namespace atrium::ui {

namespace {
constexpr int kMaxRecent = 10;
constexpr int kAutosaveSeconds = 30;
constexpr int kShortestAutosave = 10;
constexpr int kLongestAutosave = 120;
const QString kLanguage = QStringLiteral("program/language");
const QString kAutosave = QStringLiteral("program/autosave_seconds");
const QString kMemory = QStringLiteral("program/memory_mib");
const QString kGeometry = QStringLiteral("window/geometry");
const QString kLayout = QStringLiteral("window/layout1"); // the number rises when the docks change
const QString kRecent = QStringLiteral("files/recent");
const QString kFolder = QStringLiteral("files/folder");
const QString kPhotometryFolder = QStringLiteral("files/photometry_folder");
const QString kDirect = QStringLiteral("view/direct_light");
const QString kDiffuse = QStringLiteral("view/diffuse_light");
const QString kCaustic = QStringLiteral("view/caustics");
const QString kSnapOn = QStringLiteral("snap/on");
constexpr const char* kSnapGrid = "snap/grid_metres";
constexpr const char* kSnapAngle = "snap/angle_degrees";
const QString kSnapSurfaces = QStringLiteral("snap/slide_on_surfaces");
const QString kSnapTurn = QStringLiteral("snap/turn_to_surface");
const QString kSnapOwn = QStringLiteral("snap/own_axes");
const QString kFurniture = QStringLiteral("library/furniture_folder");
const QString kFalseColor = QStringLiteral("view/false_colour");
const QString kContours = QStringLiteral("view/contours");

QString quantity_key(LightQuantity quantity) {
    return quantity == LightQuantity::Illuminance ? QStringLiteral("illuminance") : QStringLiteral("luminance");
}
} // namespace

QString shares_text(const LightShares& shares) {
    QStringList names;
    if (shares.direct) {
        names.append(QCoreApplication::translate("LightShares", "direct light"));
    }
    if (shares.diffuse) {
        names.append(QCoreApplication::translate("LightShares", "diffuse light"));
    }
    if (shares.caustic) {
        names.append(QCoreApplication::translate("LightShares", "caustics"));
    }
    return names.join(QCoreApplication::translate("LightShares", ", ", "between items of a list"));
}

QByteArray Settings::geometry() const { return QSettings().value(kGeometry).toByteArray(); }
QByteArray Settings::layout() const { return QSettings().value(kLayout).toByteArray(); }

void Settings::set_window(const QByteArray& geometry, const QByteArray& layout) {
    QSettings settings;
    settings.setValue(kGeometry, geometry);
    settings.setValue(kLayout, layout);
}

QStringList Settings::recent_files() const { return QSettings().value(kRecent).toStringList(); }

void Settings::add_recent(const QString& path) {
    const QFileInfo info(path);
    QStringList files = recent_files();
    files.removeAll(info.absoluteFilePath());
    files.prepend(info.absoluteFilePath());
    QSettings().setValue(kRecent, QStringList(files.mid(0, kMaxRecent)));
    set_last_folder(info.absolutePath());
}

void Settings::remove_recent(const QString& path) {
    QStringList files = recent_files();
    files.removeAll(path);
    QSettings().setValue(kRecent, files);
}

QString Settings::last_folder() const {
    const QString folder = QSettings().value(kFolder).toString();
    return !folder.isEmpty() && QDir(folder).exists() ? folder
                                                      : QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
}

void Settings::set_last_folder(const QString& folder) { QSettings().setValue(kFolder, folder); }

QString Settings::photometry_folder() const {
    const QString folder = QSettings().value(kPhotometryFolder).toString();
    return !folder.isEmpty() && QDir(folder).exists() ? folder : last_folder();
}

void Settings::set_photometry_folder(const QString& folder) { QSettings().setValue(kPhotometryFolder, folder); }

LightShares Settings::light_shares() const {
    const QSettings settings;
    const LightShares shares{settings.value(kDiffuse, true).toBool(), settings.value(kDirect, true).toBool(),
                             settings.value(kCaustic, true).toBool()};
    return shares.diffuse || shares.direct || shares.caustic ? shares : LightShares{};
}

void Settings::set_light_shares(const LightShares& shares) {
    QSettings settings;
    settings.setValue(kDirect, shares.direct);
    settings.setValue(kDiffuse, shares.diffuse);
    settings.setValue(kCaustic, shares.caustic);
}

Snapping Settings::snapping() const {
    const QSettings settings;
    const Snapping plain;
    // Steps that somebody wrote by hand must not divide by zero.
    const auto step = [&](const char* key, double otherwise) {
        const double value = settings.value(QLatin1StringView(key), otherwise).toDouble();
        return value > 1e-4 && value < 1e3 ? value : otherwise;
    };
    Snapping out;
    out.on = settings.value(kSnapOn, false).toBool();
    out.grid = step(kSnapGrid, plain.grid);
    out.angle = radians_from_degrees(step(kSnapAngle, degrees_from_radians(plain.angle)));
    out.on_surfaces = settings.value(kSnapSurfaces, false).toBool();
    out.turn_to_surface = settings.value(kSnapTurn, false).toBool();
    out.own_axes = settings.value(kSnapOwn, false).toBool();
    return out;
}

void Settings::set_snapping(const Snapping& snapping) {
    QSettings settings;
    settings.setValue(kSnapOn, snapping.on);
    settings.setValue(QLatin1StringView(kSnapGrid), snapping.grid);
    settings.setValue(QLatin1StringView(kSnapAngle), degrees_from_radians(snapping.angle));
    settings.setValue(kSnapSurfaces, snapping.on_surfaces);
    settings.setValue(kSnapTurn, snapping.turn_to_surface);
    settings.setValue(kSnapOwn, snapping.own_axes);
}

QString Settings::furniture_folder() const { return QSettings().value(kFurniture).toString(); }
void Settings::set_furniture_folder(const QString& folder) { QSettings().setValue(kFurniture, folder); }
std::optional<LightQuantity> Settings::false_color() const {
    const QString name = QSettings().value(kFalseColor).toString();
    for (const LightQuantity quantity : {LightQuantity::Illuminance, LightQuantity::Luminance}) {
        if (name == quantity_key(quantity)) {
            return quantity;
        }
    }
    return std::nullopt;
}

void Settings::set_false_color(std::optional<LightQuantity> quantity) {
    QSettings().setValue(kFalseColor, quantity ? quantity_key(*quantity) : QString());
}

ScaleChoice Settings::scale_choice(LightQuantity quantity) const {
    QSettings settings;
    settings.beginGroup(QStringLiteral("view/scale_") + quantity_key(quantity));
    ScaleChoice out;
    out.logarithmic = settings.value(QStringLiteral("logarithmic"), out.logarithmic).toBool();
    out.automatic = settings.value(QStringLiteral("automatic"), out.automatic).toBool();
    out.minimum = settings.value(QStringLiteral("minimum"), out.minimum).toDouble();
    out.maximum = settings.value(QStringLiteral("maximum"), out.maximum).toDouble();
    return out;
}

void Settings::set_scale_choice(LightQuantity quantity, const ScaleChoice& choice) {
    QSettings settings;
    settings.beginGroup(QStringLiteral("view/scale_") + quantity_key(quantity));
    settings.setValue(QStringLiteral("logarithmic"), choice.logarithmic);
    settings.setValue(QStringLiteral("automatic"), choice.automatic);
    settings.setValue(QStringLiteral("minimum"), choice.minimum);
    settings.setValue(QStringLiteral("maximum"), choice.maximum);
}

Appearance Settings::appearance() const { return appearance_of(QSettings().value(QStringLiteral("appearance")).toString()); }

void Settings::set_appearance(Appearance appearance) {
    QSettings().setValue(QStringLiteral("appearance"), appearance_name(appearance));
}

QString Settings::language() const { return QSettings().value(kLanguage).toString(); }
void Settings::set_language(const QString& language) { QSettings().setValue(kLanguage, language); }

int Settings::autosave_seconds() const {
    return std::clamp(QSettings().value(kAutosave, kAutosaveSeconds).toInt(), kShortestAutosave, kLongestAutosave);
}
void Settings::set_autosave_seconds(int seconds) { QSettings().setValue(kAutosave, seconds); }

int Settings::memory_mib() const {
    constexpr int kLeast = 64, kMost = 1 << 24;
    const int mib = QSettings().value(kMemory, 0).toInt();
    return mib > 0 ? std::clamp(mib, kLeast, kMost) : 0;
}
void Settings::set_memory_mib(int mib) { QSettings().setValue(kMemory, mib); }

bool Settings::contours() const { return QSettings().value(kContours, false).toBool(); }
void Settings::set_contours(bool on) { QSettings().setValue(kContours, on); }

} // namespace atrium::ui
