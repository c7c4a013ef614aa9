#include "ui/document/engine_text.h"

#include <QCoreApplication>
#include <QHash>
#include <QRegularExpression>

#include <algorithm>

namespace atrium::ui {
namespace {

// What engine/ says, word for word; %1, %2, ... stand for the names and numbers in it.
constexpr const char* kMessages[] = {
    QT_TRANSLATE_NOOP("Engine", "cannot be opened: %1"),
    QT_TRANSLATE_NOOP("Engine", "is not a regular file"),
    QT_TRANSLATE_NOOP("Engine", "is larger than %1 MiB"),
    QT_TRANSLATE_NOOP("Engine", "cannot be read: %1"),
    QT_TRANSLATE_NOOP("Engine", "became shorter while being read"),
    QT_TRANSLATE_NOOP("Engine", "cannot be written: %1"),
    QT_TRANSLATE_NOOP("Engine", "cannot be replaced: %1"),
    QT_TRANSLATE_NOOP("Engine", "could not be written: %1"),
    QT_TRANSLATE_NOOP("Engine", "Choose a folder that exists and that you may write to."),
    QT_TRANSLATE_NOOP("Engine", "The file that was there before is unchanged."),
    QT_TRANSLATE_NOOP("Engine",
                      "The file that was there before is unchanged. Free some space, or save into another folder."),
    QT_TRANSLATE_NOOP("Engine", "\"%1\" is not a file beside the scene"),
    QT_TRANSLATE_NOOP("Engine", "Only relative file names and data: are opened."),
    QT_TRANSLATE_NOOP("Engine", "the folder of the scene cannot be read: %1"),
    QT_TRANSLATE_NOOP("Engine", "\"%1\" lies outside the folder of the scene and was not opened"),
    QT_TRANSLATE_NOOP("Engine", "Put the file into the scene's folder and refer to it by a relative name."),
    QT_TRANSLATE_NOOP("Engine", "The file is damaged or incomplete; copy or export it again."),
    QT_TRANSLATE_NOOP("Engine", "It is damaged or was cut off; get it again from the maker."),
    QT_TRANSLATE_NOOP("Engine", "holds %1 bytes where the file announces %2"),
    QT_TRANSLATE_NOOP("Engine", "the file is empty"),
    QT_TRANSLATE_NOOP("Engine", "is not a glTF file: the JSON text is not an object"),
    QT_TRANSLATE_NOOP("Engine", "is neither glTF text nor a binary glTF file"),
    QT_TRANSLATE_NOOP("Engine", "Choose a .gltf, .glb or .atrium file."),
    QT_TRANSLATE_NOOP("Engine", "the file ends after %1 bytes"),
    QT_TRANSLATE_NOOP("Engine", "its header is cut off"),
    QT_TRANSLATE_NOOP("Engine", "glTF version \"%1\" is not supported"),
    QT_TRANSLATE_NOOP("Engine", "Export the file as glTF 2.0."),
    QT_TRANSLATE_NOOP("Engine", "This is not a glTF 2.0 file."),
    QT_TRANSLATE_NOOP("Engine", "The file is incomplete; export it again."),
    QT_TRANSLATE_NOOP("Engine", "is missing"),
    QT_TRANSLATE_NOOP("Engine", "\"%1\" is missing"),
    QT_TRANSLATE_NOOP("Engine", "refers to something that the file does not have"),
    QT_TRANSLATE_NOOP("Engine", "nothing of the scene's description can be read"),
    QT_TRANSLATE_NOOP("Engine", "the scene is larger than 4 GiB, more than one binary glTF file can hold"),
    QT_TRANSLATE_NOOP("Engine", "Save as .gltf."),
    QT_TRANSLATE_NOOP("Engine", "is not valid glTF: %1"),
    QT_TRANSLATE_NOOP("Engine", "Export the file again."),
    QT_TRANSLATE_NOOP("Engine", "there is not enough memory to open the file"),
    QT_TRANSLATE_NOOP("Engine", "is not a kind of scene file that can be written"),
    QT_TRANSLATE_NOOP("Engine", "Name it .atrium, .glb or .gltf."),
    QT_TRANSLATE_NOOP("Engine", "is not at hand"),
    QT_TRANSLATE_NOOP("Engine", "Put it beside the scene file, where it was exported."),
    QT_TRANSLATE_NOOP("Engine", "not an image of a known format"),
    QT_TRANSLATE_NOOP("Engine", "the image is empty"),
    QT_TRANSLATE_NOOP("Engine", "Use PNG, JPEG, HDR or EXR."),
    QT_TRANSLATE_NOOP("Engine", "the image cannot be decoded: %1"),
    QT_TRANSLATE_NOOP("Engine", "the image has no pixels that can be used"),
    QT_TRANSLATE_NOOP("Engine", "the image is too large: %1 x %2"),
    QT_TRANSLATE_NOOP("Engine", "Scale it down to at most 8192 x 8192."),
    QT_TRANSLATE_NOOP("Engine", "the image is damaged: %1"),
    QT_TRANSLATE_NOOP("Engine", "Surfaces that use it show their plain colour."),
    QT_TRANSLATE_NOOP("Engine", "has no image that can be read"),
    QT_TRANSLATE_NOOP("Engine", "is neither .exr nor .png"),
    QT_TRANSLATE_NOOP("Engine", "Name the picture .exr or .png."),
    QT_TRANSLATE_NOOP("Engine", "the picture could not be encoded: %1"),
    QT_TRANSLATE_NOOP("Engine", "a light of the unknown type \"%1\" was left out"),
    QT_TRANSLATE_NOOP("Engine", "Use a point, spot or directional light."),
    QT_TRANSLATE_NOOP("Engine", "a colour of %1 was set to 1: with it the light would be too strong"),
    QT_TRANSLATE_NOOP("Engine", "a height of 0 was set to 1 m"),
    QT_TRANSLATE_NOOP("Engine", "a base colour of %1 was set to %2"),
    QT_TRANSLATE_NOOP("Engine", "A surface cannot reflect more light than falls on it."),
    QT_TRANSLATE_NOOP("Engine", "an emissive strength of %1 was set to 1"),
    QT_TRANSLATE_NOOP("Engine", "an emissive strength of %1 was set to %2 cd/m2"),
    QT_TRANSLATE_NOOP("Engine", "a negative emissive colour was set to 0"),
    QT_TRANSLATE_NOOP("Engine", "Light cannot be negative."),
    QT_TRANSLATE_NOOP("Engine", "The sun has 1.6e9 cd/m2."),
    QT_TRANSLATE_NOOP("Engine", "an index of refraction of %1 was set to 1.5"),
    QT_TRANSLATE_NOOP("Engine", "It must be at least 1: glass 1.5, water 1.33."),
    QT_TRANSLATE_NOOP("Engine", "an attenuation distance that is not positive was ignored"),
    QT_TRANSLATE_NOOP("Engine", "has no positions and is not shown"),
    QT_TRANSLATE_NOOP("Engine", "has no triangles and is not shown"),
    QT_TRANSLATE_NOOP("Engine", "a rotation without direction was left out"),
    QT_TRANSLATE_NOOP("Engine", "a rotation that was not of unit length was normalised"),
    QT_TRANSLATE_NOOP("Engine", "the last row of its matrix is not 0 0 0 1 and was replaced by that"),
    QT_TRANSLATE_NOOP("Engine", "%1 instances became nodes of their own"),
    QT_TRANSLATE_NOOP("Engine", "the extension %1 is not interpreted"),
    QT_TRANSLATE_NOOP("Engine", "What it says about materials is kept when saving."),
    QT_TRANSLATE_NOOP("Engine", "animations are not played and will not be saved"),
    QT_TRANSLATE_NOOP("Engine", "Lamps that use it shine as plain lights, or not at all."),
    QT_TRANSLATE_NOOP("Engine", "is larger than 32 MiB, so it is no photometric file"),
    QT_TRANSLATE_NOOP("Engine", "Choose an IES file (LM-63)."),
    QT_TRANSLATE_NOOP("Engine", "is no text file"),
    QT_TRANSLATE_NOOP("Engine", "Choose an IES file (LM-63), which is plain text."),
    QT_TRANSLATE_NOOP("Engine", "has no TILT= line, so it is no IES photometric file"),
    QT_TRANSLATE_NOOP("Engine", "Choose an LM-63 file (.ies), or ask the maker of the luminaire for one."),
    QT_TRANSLATE_NOOP("Engine", "all intensities are 0, so there would be no light"),
    QT_TRANSLATE_NOOP("Engine", "Choose another file."),
    QT_TRANSLATE_NOOP("Engine", "is no text file of at most 32 MiB"),
    QT_TRANSLATE_NOOP("Engine", "Choose an EULUMDAT file (.ldt)."),
    QT_TRANSLATE_NOOP("Engine", "the stored solution has another length than the file says"),
    QT_TRANSLATE_NOOP("Engine", "the stored solution is damaged"),
    QT_TRANSLATE_NOOP("Engine", "it is damaged"),
    QT_TRANSLATE_NOOP("Engine", "it was written by another version of the program"),
    QT_TRANSLATE_NOOP("Engine", "The light is computed again"),
    QT_TRANSLATE_NOOP("Engine", "stopped before the first picture"),
    QT_TRANSLATE_NOOP("Engine", "Give it more time, or choose draft quality"),
    QT_TRANSLATE_NOOP("Engine", "the audit was stopped"),
    QT_TRANSLATE_NOOP("Engine", "Give it more time."),
    QT_TRANSLATE_NOOP("Engine", "there is nothing to compare: light reaches no surface that scatters it"),
    QT_TRANSLATE_NOOP("Engine", "Add a lamp, daylight or a matt surface."),
    QT_TRANSLATE_NOOP("Engine", "There is not enough memory for the light of this scene."),
    QT_TRANSLATE_NOOP("Engine", "The light simulation failed: %1"),
    QT_TRANSLATE_NOOP("Engine", "The light simulation failed for an unknown reason."),
    QT_TRANSLATE_NOOP("Engine", "The light simulation returned no picture."),
    QT_TRANSLATE_NOOP("Engine", "there is no light in it, so everything is black"),
    QT_TRANSLATE_NOOP("Engine", "Add a light, let a material emit, or give the environment a sky"),
    QT_TRANSLATE_NOOP("Engine", "its scale is zero, so its camera has no direction"),
    QT_TRANSLATE_NOOP("Engine", "Set the scale to 1"),
    QT_TRANSLATE_NOOP("Engine", "its scale is zero, so it has no volume"),
    QT_TRANSLATE_NOOP("Engine", "Set the scale to 1 or hide the node"),
    QT_TRANSLATE_NOOP("Engine", "it shows nothing: %1"),
    QT_TRANSLATE_NOOP("Engine", "Give it a size or delete it"),
    QT_TRANSLATE_NOOP("Engine", "it names more materials than its shape has parts"),
    QT_TRANSLATE_NOOP("Engine", "The surplus is ignored"),
    QT_TRANSLATE_NOOP("Engine", "it refers to a texture that does not exist"),
    QT_TRANSLATE_NOOP("Engine", "The plain colour stands in"),
    QT_TRANSLATE_NOOP("Engine", "its %1 of %2 is outside %3 to %4"),
    QT_TRANSLATE_NOOP("Engine", "Set it within that range"),
    QT_TRANSLATE_NOOP("Engine", "a colour of it is negative"),
    QT_TRANSLATE_NOOP("Engine", "Negative light and reflectance count as zero"),
    QT_TRANSLATE_NOOP("Engine", "it reflects %1 % of the light, with which a closed room would grow brighter without end"),
    QT_TRANSLATE_NOOP("Engine", "its intensity or colour is negative"),
    QT_TRANSLATE_NOOP("Engine", "Negative light counts as none"),
    QT_TRANSLATE_NOOP("Engine", "it is switched on but its intensity is zero"),
    QT_TRANSLATE_NOOP("Engine", "Set an intensity or switch it off"),
    QT_TRANSLATE_NOOP("Engine", "it has a photometric file, which a sun cannot have"),
    QT_TRANSLATE_NOOP("Engine", "The file is ignored"),
    QT_TRANSLATE_NOOP("Engine", "the inner angle of its cone is not smaller than the outer, or that is over 90 degrees"),
    QT_TRANSLATE_NOOP("Engine", "Set 0 <= inner < outer <= 90 degrees"),
    QT_TRANSLATE_NOOP("Engine", "its field of view is not between 0 and 180 degrees"),
    QT_TRANSLATE_NOOP("Engine", "40 to 70 degrees suit a room"),
    QT_TRANSLATE_NOOP("Engine", "it shows a height of zero"),
    QT_TRANSLATE_NOOP("Engine", "Set its height in metres"),
    QT_TRANSLATE_NOOP("Engine", "its far plane is not behind its near plane"),
    QT_TRANSLATE_NOOP("Engine", "Set 0 < near < far"),
    QT_TRANSLATE_NOOP("Engine", "its points lie far from its own origin, where their coordinates have steps of %1 mm"),
    QT_TRANSLATE_NOOP("Engine", "Export it with its origin nearby and move the object instead"),
    QT_TRANSLATE_NOOP("Engine", "it has no visible surface"),
    QT_TRANSLATE_NOOP("Engine", "Show a node, or add a shape"),
    QT_TRANSLATE_NOOP("Engine", "it is smaller than a millimetre"),
    QT_TRANSLATE_NOOP("Engine", "it and %1 more are smaller than a millimetre"),
    QT_TRANSLATE_NOOP("Engine", "Such detail costs time and is hardly seen"),
    QT_TRANSLATE_NOOP("Engine", "there is no such %1"),
    QT_TRANSLATE_NOOP("Engine", "It may have been deleted"),
    QT_TRANSLATE_NOOP("Engine", "a size or coordinate is not a finite number"),
    QT_TRANSLATE_NOOP("Engine", "a value of the material is not a finite number"),
    QT_TRANSLATE_NOOP("Engine", "it emits more than 1e12 cd/m2"),
    QT_TRANSLATE_NOOP("Engine", "a value of the light is not a finite number"),
    QT_TRANSLATE_NOOP("Engine", "its intensity is more than 1e12"),
    QT_TRANSLATE_NOOP("Engine", "Set it in candela, or in lux for a sun."),
    QT_TRANSLATE_NOOP("Engine", "a value of the camera is not a finite number"),
    QT_TRANSLATE_NOOP("Engine", "its position, rotation or scale is not a finite number"),
    QT_TRANSLATE_NOOP("Engine", "it cannot be moved below %1, which is part of it"),
    QT_TRANSLATE_NOOP("Engine", "more_links"),
    QT_TRANSLATE_NOOP("Engine", "finer_light_maps"),
    QT_TRANSLATE_NOOP("Engine", "more_vertices"),
    QT_TRANSLATE_NOOP("Engine", "more_particles"),
    QT_TRANSLATE_NOOP("Engine", "finer_caustic_textures"),
    QT_TRANSLATE_NOOP("Engine", "The light may take %1 MiB of memory."),
    QT_TRANSLATE_NOOP("Engine", "caustic_textures"),
    QT_TRANSLATE_NOOP("Engine", "octree"),
    QT_TRANSLATE_NOOP("Engine", "refraction"),
    QT_TRANSLATE_NOOP("Engine", "glossy"),
    QT_TRANSLATE_NOOP("Engine", "direct_layer"),
    QT_TRANSLATE_NOOP("Engine", "specular_view"),
    QT_TRANSLATE_NOOP("Engine", "transmittance"),
    QT_TRANSLATE_NOOP("Engine", "alpha_cutouts"),
    QT_TRANSLATE_NOOP("Engine", "photometry"),
    QT_TRANSLATE_NOOP("Engine", "particles"),
    QT_TRANSLATE_NOOP("Engine", "textures"),
    QT_TRANSLATE_NOOP("Engine", "sun"),
    QT_TRANSLATE_NOOP("Engine", "sky"),
    QT_TRANSLATE_NOOP("Engine", "There is no specular surface in the scene."),
    QT_TRANSLATE_NOOP("Engine", "There is no glass in the scene."),
    QT_TRANSLATE_NOOP("Engine", "All glass is in thin sheets, which light crosses unbent."),
    QT_TRANSLATE_NOOP("Engine", "There is no mirror, metal or glass in the scene."),
    QT_TRANSLATE_NOOP("Engine", "Every surface is opaque."),
    QT_TRANSLATE_NOOP("Engine", "Nothing in the scene gives light."),
    QT_TRANSLATE_NOOP("Engine", "The sky shines with %1 cd/m2."),
    QT_TRANSLATE_NOOP("Engine", "The environment is black."),
    QT_TRANSLATE_NOOP("Engine", "There is no directional light in the scene."),
    QT_TRANSLATE_NOOP("Engine", "The directional light %1 shines."),
    QT_TRANSLATE_NOOP("Engine", "Made where what particles bring has finer detail than the mesh."),
    QT_TRANSLATE_NOOP("Engine", "Nothing is selected to move."),
    QT_TRANSLATE_NOOP("Engine", "There is no glossy metal in the scene."),
    QT_TRANSLATE_NOOP("Engine", "No shown surface has a texture that changes light."),
    QT_TRANSLATE_NOOP("Engine", "No surface is cut out by its alpha."),
    QT_TRANSLATE_NOOP("Engine", "No lamp has a photometric file."),
};

/// Messages with names or numbers in them, as patterns.
struct Pattern {
    const char* message;
    QRegularExpression expression;
};

const std::vector<Pattern>& patterns() {
    static const std::vector<Pattern> made = [] {
        static const QRegularExpression place(QStringLiteral("%\\d"));
        std::vector<Pattern> out;
        for (const char* message : kMessages) {
            const QString text = QString::fromUtf8(message);
            if (!text.contains(place)) {
                continue;
            }
            QStringList pieces = text.split(place);
            for (QString& piece : pieces) {
                piece = QRegularExpression::escape(piece);
            }
            const QString expression = pieces.join(QStringLiteral("(.+)"));
            out.push_back({message, QRegularExpression(QRegularExpression::anchoredPattern(expression),
                                                       QRegularExpression::DotMatchesEverythingOption)});
        }
        return out;
    }();
    return made;
}

} // namespace

std::span<const char* const> engine_messages() { return kMessages; }

QString engine_text(const std::string& text) {
    static const QHash<QString, const char*> whole = [] {
        QHash<QString, const char*> out;
        for (const char* message : kMessages) {
            out.insert(QString::fromUtf8(message), message);
        }
        return out;
    }();
    const QString said = QString::fromStdString(text);
    if (const auto known = whole.find(said); known != whole.end()) {
        return QCoreApplication::translate("Engine", *known);
    }
    for (const Pattern& pattern : patterns()) {
        const QRegularExpressionMatch match = pattern.expression.match(said);
        if (!match.hasMatch()) {
            continue;
        }
        QString out = QCoreApplication::translate("Engine", pattern.message);
        for (int i = match.lastCapturedIndex(); i > 0; --i) {
            // From the last on, and by hand: what is put in may have a %1 in it.
            const QString place = QStringLiteral("%%1").arg(i);
            if (const auto at = out.lastIndexOf(place); at >= 0) {
                out.replace(at, place.size(), match.captured(i));
            }
        }
        return out;
    }
    return said;
}

QString error_message(const Error& error) {
    Error said = error;
    said.what = engine_text(error.what).toStdString();
    said.hint = engine_text(error.hint).toStdString();
    return QString::fromStdString(said.message());
}

} // namespace atrium::ui
