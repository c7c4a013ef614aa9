#include "ui/document/library.h"

#include "ui/document/edit_builder.h"
#include "ui/document/insert_commands.h"

#include <QColor>
#include <QCoreApplication>
#include <QFile>
#include <QJsonArray>
#include <QJsonDocument>
#include <QJsonObject>

#include <algorithm>
#include <map>

namespace atrium::ui {
namespace {

/// What is wrong with an entry; caught where the entry's key is known.
struct BadEntry {
    std::string what;
};

double number(const QJsonObject& json, const char* key, double otherwise) {
    const QJsonValue value = json.value(QLatin1StringView(key));
    if (!value.isUndefined() && !value.isDouble()) {
        throw BadEntry{std::string("\"") + key + "\" is not a number"};
    }
    return value.toDouble(otherwise);
}

double positive(const QJsonObject& json, const char* key) {
    const double value = number(json, key, 0.0);
    if (!(value > 0.0)) {
        throw BadEntry{std::string("\"") + key + "\" must be a number above 0"};
    }
    return value;
}

std::vector<double> numbers(const QJsonObject& json, const char* key, std::size_t count) {
    const QJsonArray array = json.value(QLatin1StringView(key)).toArray();
    std::vector<double> out;
    for (const auto& value : array) {
        out.push_back(value.toDouble(std::numeric_limits<double>::quiet_NaN()));
    }
    if (out.size() != count || std::any_of(out.begin(), out.end(), [](double v) { return !std::isfinite(v); })) {
        throw BadEntry{std::string("\"") + key + "\" must be " + std::to_string(count) + " numbers"};
    }
    return out;
}

Material read_material(const QJsonObject& json) {
    Material out;
    out.name = json.value(QLatin1StringView("name")).toString().toStdString();
    const QColor color(json.value(QLatin1StringView("color")).toString());
    if (!color.isValid()) {
        throw BadEntry{"\"color\" must be #RRGGBB"};
    }
    const Rgb hue(srgb_to_linear(float(color.redF())), srgb_to_linear(float(color.greenF())),
                  srgb_to_linear(float(color.blueF())));
    const char* share = json.contains(QLatin1StringView("lrv")) ? "lrv" : "reflectance";
    const double wanted = positive(json, share) / 100.0;
    const Rgb scaled = hue * float(wanted) / std::max(luminance(hue), 1e-6F);
    if (wanted > 1.0 || max_component(scaled) > 1.001F) {
        throw BadEntry{"no colour of this hue reflects as much"};
    }
    out.base_color = glm::min(scaled, Rgb(1.0F));
    out.roughness = float(number(json, "roughness", 0.6));
    out.metallic = float(number(json, "metallic", 0.0));
    out.transmission = float(number(json, "transmission", 0.0));
    out.ior = float(number(json, "ior", 1.5));
    out.thickness = float(number(json, "thickness", 0.0));
    out.double_sided = json.value(QLatin1StringView("double_sided")).toBool();
    return out;
}

struct Body {
    Geometry geometry;
    double area = 0; ///< of its front, square metres
    bool flat = false;
};

Body read_body(const QJsonObject& json) {
    const QString kind = json.value(QLatin1StringView("shape")).toString();
    if (kind == QLatin1StringView("box")) {
        const auto s = numbers(json, "size", 3);
        return {Box{vec3(float(s[0]), float(s[1]), float(s[2]))}, 2 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0])};
    }
    if (kind == QLatin1StringView("rectangle")) {
        const auto s = numbers(json, "size", 2);
        const float x = float(s[0] / 2);
        const float y = float(s[1] / 2);
        return {Polygon{{{-x, -y}, {x, -y}, {x, y}, {-x, y}}, {}}, s[0] * s[1], true};
    }
    if (kind == QLatin1StringView("disc")) {
        const double r = positive(json, "radius");
        return {Disc{float(r)}, kPiD * r * r, true};
    }
    if (kind == QLatin1StringView("sphere")) {
        const double r = positive(json, "radius");
        return {Sphere{float(r)}, 4 * kPiD * r * r};
    }
    const bool capped = json.value(QLatin1StringView("capped")).toBool(true);
    if (kind == QLatin1StringView("cylinder")) {
        const double r = positive(json, "radius");
        const double h = positive(json, "height");
        return {Cylinder{float(r), float(h), capped}, 2 * kPiD * r * h + (capped ? 2 * kPiD * r * r : 0.0)};
    }
    if (kind == QLatin1StringView("cone")) {
        const double a = positive(json, "base");
        const double b = number(json, "top", 0.0);
        const double h = positive(json, "height");
        const double side = kPiD * (a + b) * std::hypot(h, a - b);
        return {Cone{float(a), float(b), float(h), capped}, side + (capped ? kPiD * (a * a + b * b) : 0.0)};
    }
    throw BadEntry{"unknown shape \"" + kind.toStdString() + '"'};
}

/// Surface that sends out `lumens` evenly in the sense of Lambert: flux = pi * luminance * area.
Material emitting(const QJsonObject& emit, double area) {
    Material out;
    const Rgb color = black_body_color(positive(emit, "kelvin"));
    const float strongest = max_component(color); // glTF wants factors of at most 1
    out.base_color = Rgb(0.8F);
    out.emissive_color = color / strongest;
    out.emissive_strength = float(positive(emit, "lumens") / (kPiD * area)) * strongest;
    return out;
}

Light read_light(const QJsonObject& json) {
    Light out;
    const Rgb color = black_body_color(positive(json, "kelvin"));
    const double lumens = positive(json, "lumens");
    const float strongest = max_component(color);
    out.color = color / strongest;
    const QString kind = json.value(QLatin1StringView("light")).toString();
    if (kind == QLatin1StringView("point")) {
        out.intensity = float(lumens / (4 * kPiD)) * strongest;
        return out;
    }
    if (kind != QLatin1StringView("spot")) {
        throw BadEntry{"unknown light \"" + kind.toStdString() + '"'};
    }
    out.kind = Light::Kind::Spot;
    const double outer = radians_from_degrees(positive(json, "beam")) / 2;
    const double inner = 0.6 * outer;
    out.outer_cone = float(outer);
    out.inner_cone = float(inner);
    // Flux of the squared falloff between the cones: 2 pi I ((1 - cos i) + (cos i - cos o) / 3).
    const double full = 2 * kPiD * ((1 - std::cos(inner)) + (std::cos(inner) - std::cos(outer)) / 3);
    out.intensity = float(lumens / full) * strongest;
    return out;
}

Scene read_object(const QJsonObject& json, const std::string& name, const std::map<QString, Material>& materials) {
    Scene empty;
    EditBuilder builder(empty);
    Node group;
    group.name = name;
    const QJsonArray parts = json.value(QLatin1StringView("parts")).toArray();
    if (parts.isEmpty()) {
        throw BadEntry{"no parts"};
    }
    const bool alone = parts.size() == 1;
    const NodeId top = alone ? NodeId{} : builder.add_node(std::move(group));
    std::map<QString, MaterialId> used;
    const dquat out_of(glm::angleAxis(-kPiD / 2, dvec3(1, 0, 0))); // local +z to +y
    const dquat into(glm::angleAxis(kPiD / 2, dvec3(1, 0, 0)));    // local -z, where lights shine, to +y
    for (const auto& value : parts) {
        const QJsonObject part = value.toObject();
        Node node;
        node.parent = top;
        if (part.contains(QLatin1StringView("at"))) {
            const auto at = numbers(part, "at", 3);
            node.transform.translation = dvec3(at[0], at[1], at[2]);
        }
        if (part.contains(QLatin1StringView("light"))) {
            node.name = alone ? name : "Light";
            Light light = read_light(part);
            light.name = name;
            node.light = builder.add_resource(builder.scene().lights, std::move(light));
            node.transform.rotation = into;
            builder.add_node(std::move(node));
            continue;
        }
        Body body = read_body(part);
        if (body.flat) {
            const bool out = part.value(QLatin1StringView("face")).toString() != QLatin1StringView("in");
            node.transform.rotation = out ? out_of : into;
        }
        const QJsonObject emit = part.value(QLatin1StringView("emit")).toObject();
        if (!emit.isEmpty()) {
            node.name = alone ? name : "Lamp";
            Material lamp = emitting(emit, body.area);
            lamp.name = name;
            node.materials.assign(1, builder.add_resource(builder.scene().materials, std::move(lamp)));
        } else {
            const QString key = part.value(QLatin1StringView("material")).toString();
            const auto known = materials.find(key);
            if (known == materials.end()) {
                throw BadEntry{"unknown material \"" + key.toStdString() + '"'};
            }
            node.name = alone ? name : known->second.name;
            MaterialId& id = used[key];
            if (!id) {
                id = builder.add_resource(builder.scene().materials, Material(known->second));
            }
            node.materials.assign(1, id);
        }
        node.shape = builder.add_resource(builder.scene().shapes, Shape{node.name, std::move(body.geometry), {}});
        builder.add_node(std::move(node));
    }
    (void)atrium::apply(empty, builder.finish());
    return empty;
}

Mount read_mount(const QJsonObject& json) {
    const QString mount = json.value(QLatin1StringView("mount")).toString();
    if (mount == QLatin1StringView("face")) {
        return Mount::Face;
    }
    if (mount == QLatin1StringView("ceiling")) {
        return Mount::Ceiling;
    }
    if (mount != QLatin1StringView("stand")) {
        throw BadEntry{"unknown mount \"" + mount.toStdString() + '"'};
    }
    return Mount::Stand;
}

} // namespace

Rgb black_body_color(double kelvin) {
    const double t = std::clamp(kelvin, 1667.0, 25000.0);
    const double u = 1e3 / t;
    const double x = t <= 4000 ? ((-0.2661239 * u - 0.2343589) * u + 0.8776956) * u + 0.179910
                               : ((-3.0258469 * u + 2.1070379) * u + 0.2226347) * u + 0.240390;
    double y = 0;
    if (t <= 2222) {
        y = ((-1.1063814 * x - 1.34811020) * x + 2.18555832) * x - 0.20219683;
    } else if (t <= 4000) {
        y = ((-0.9549476 * x - 1.37418593) * x + 2.09137015) * x - 0.16748867;
    } else {
        y = ((3.0817580 * x - 5.87338670) * x + 3.75112997) * x - 0.37001483;
    }
    const double cx = x / y;
    const double cz = (1 - x - y) / y;
    const dvec3 rgb(3.2404542 * cx - 1.5371385 - 0.4985314 * cz, -0.9692660 * cx + 1.8760108 + 0.0415560 * cz,
                    0.0556434 * cx - 0.2040259 + 1.0572252 * cz);
    const Rgb seen(glm::max(rgb, dvec3(0.0))); // candle light lies outside the triangle of the primaries
    return seen / luminance(seen);
}

Result<std::vector<LibraryItem>> parse_library(const QByteArray& json) {
    QJsonParseError error;
    const QJsonObject root = QJsonDocument::fromJson(json, &error).object();
    if (error.error != QJsonParseError::NoError) {
        return fail("library.json", {}, error.errorString().toStdString());
    }
    std::vector<LibraryItem> out;
    std::map<QString, Material> materials;
    const std::pair<const char*, LibrarySection> sections[] = {{"materials", LibrarySection::Materials},
                                                               {"shapes", LibrarySection::Shapes},
                                                               {"lamps", LibrarySection::Lamps},
                                                               {"furniture", LibrarySection::Furniture}};
    for (const auto& [list, section] : sections) {
        const QJsonArray entries = root.value(QLatin1StringView(list)).toArray();
        for (const auto& value : entries) {
            const QJsonObject entry = value.toObject();
            LibraryItem item;
            item.section = section;
            item.key = entry.value(QLatin1StringView("key")).toString();
            const QString source = entry.value(QLatin1StringView("name")).toString();
            item.name = QCoreApplication::translate("Library", source.toUtf8().constData());
            item.tip = QCoreApplication::translate("Library",
                                                   entry.value(QLatin1StringView("tip")).toString().toUtf8().constData());
            try {
                if (item.key.isEmpty() || source.isEmpty()) {
                    throw BadEntry{"an entry needs a key and a name"};
                }
                if (section == LibrarySection::Materials) {
                    Material material = read_material(entry);
                    material.name = item.name.toStdString();
                    materials[item.key] = material;
                    Scene alone;
                    const MaterialId id = alone.materials.next_key();
                    (void)atrium::apply(alone, SceneEdit{AddResource<Material>{id, material}});
                    item.scene = std::make_shared<const Scene>(material_scene(alone, id));
                } else if (section == LibrarySection::Furniture) { // its file is read when it is needed
                    item.key = QStringLiteral(":/library/furniture/%1.glb").arg(item.key);
                } else {
                    item.mount = read_mount(entry);
                    // "Pendant globe, 1000 lm, 2700 K" is called "Pendant globe" in the scene.
                    const std::string name = item.name.section(QLatin1Char(','), 0, 0).toStdString();
                    item.scene = std::make_shared<const Scene>(read_object(entry, name, materials));
                }
            } catch (const BadEntry& bad) {
                return fail("library.json", item.key.toStdString(), bad.what);
            }
            if (!entry.value(QLatin1StringView("hidden")).toBool()) {
                out.push_back(std::move(item));
            }
        }
    }
    return out;
}

const std::vector<LibraryItem>& shipped_library() {
    static const std::vector<LibraryItem> items = [] {
        QFile file(QStringLiteral(":/library/library.json"));
        (void)file.open(QIODevice::ReadOnly);
        auto read = parse_library(file.readAll());
        if (!read) {
            qWarning("%s", read.error().message().c_str());
        }
        return read ? std::move(*read) : std::vector<LibraryItem>();
    }();
    return items;
}

} // namespace atrium::ui
