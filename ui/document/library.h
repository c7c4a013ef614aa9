// What the library offers: shapes, materials, lamps and furniture that ship, told by one data file, and models in a folder.
#pragma once

#include "engine/base/result.h"
#include "engine/scene/scene.h"
#include "ui/document/placement.h"

#include <QByteArray>
#include <QString>

#include <memory>
#include <vector>

namespace atrium::ui {

enum class LibrarySection : std::uint8_t { Shapes, Materials, Lamps, Furniture };

/// One entry: something to put into a scene, or a material to give to an object.
struct LibraryItem {
    LibrarySection section = LibrarySection::Shapes;
    QString key; ///< stable; of furniture, the path of its file: what ships is a resource, ":/..."
    QString name;
    QString tip;
    Mount mount = Mount::Stand;
    /// The object in its own coordinates; of a material, material_scene(). Null for furniture that is not loaded yet.
    std::shared_ptr<const Scene> scene;

    [[nodiscard]] bool is_material() const { return section == LibrarySection::Materials; }
    /// Comes with the program, not from the user's folder.
    [[nodiscard]] bool ships() const { return section != LibrarySection::Furniture || key.startsWith(QLatin1Char(':')); }
};

/// Entries of the file resources/library/library.json (its own "about" says what the fields mean), in its order. An error
/// names the entry. Any thread.
Result<std::vector<LibraryItem>> parse_library(const QByteArray& json);
/// The library that ships, from the program's resources; read once. UI thread only.
const std::vector<LibraryItem>& shipped_library();

/// Colour of a black body, linear Rec. 709 with luminance 1, each channel at least 0. 1667 K to 25000 K, else the nearest
/// end. Cubic splines of the Planckian locus by Kim et al. (US patent 7024034, 2002).
Rgb black_body_color(double kelvin);

} // namespace atrium::ui
