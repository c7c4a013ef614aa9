#include "ui/panels/light_sections.h"

#include "engine/scene/edit_tools.h"
#include "engine/scene/photometric_web.h"
#include "ui/document/scene_commands.h"
#include "ui/panels/photometry_box.h"

#include <QPushButton>

#include <algorithm>

namespace atrium::ui {

namespace {

template <class T, class Get> auto read_each(const SlotMap<T>& pool, const std::vector<Id<T>>& ids, Get get) {
    std::vector<decltype(get(*pool.find(ids.front())))> values;
    for (const Id<T> id : ids) {
        values.push_back(get(*pool.find(id)));
    }
    return values;
}

NumberFormat intensity_format() {
    NumberFormat format = NumberFormat::plain(0, 1e9, 2, QStringLiteral(" cd"));
    format.proportional = true;
    format.units.units = {{"cd", 1.0}, {"kcd", 1000.0}};
    return format;
}

NumberFormat flux_format() {
    NumberFormat format = NumberFormat::plain(0, 1e9, 1, QStringLiteral(" lm"));
    format.proportional = true;
    format.units.units = {{"lm", 1.0}, {"klm", 1000.0}};
    return format;
}

NumberFormat dimming_format() {
    NumberFormat format = NumberFormat::plain(0, 100, 1, QStringLiteral(" %"));
    format.units.units = {{"%", 1.0}};
    format.display_factor = 100.0;
    format.step = 0.05;
    return format;
}

} // namespace

LightSection::LightSection(Document& document) : Section(tr("Lamp"), document) {
    add_check(
        tr("Switched on"), [this] { return read_each(scene().lights, targets(), [](const Light& l) { return l.enabled; }); },
        [this](bool on) { return write([on](Light& l) { l.enabled = on; }); });
    add_choice(
        tr("Kind"), {tr("Point"), tr("Spot"), tr("Sun")},
        [this] {
            // A measured lamp is of no kind: its file says how it shines.
            const auto measured =
                read_each(scene().lights, targets(), [](const Light& l) { return light_distribution(l) != nullptr; });
            return std::find(measured.begin(), measured.end(), true) != measured.end()
                       ? std::vector<int>{}
                       : read_each(scene().lights, targets(), [](const Light& l) { return int(l.kind); });
        },
        [this](int index) { return write([index](Light& l) { l.kind = Light::Kind(index); }); });
    add_color(
        tr("Colour"), [this] { return read_each(scene().lights, targets(), [](const Light& l) { return l.color; }); },
        [this](const Rgb& color) { return write([&](Light& l) { l.color = color; }); });
    intensity_ = add_number(
        tr("Intensity"), intensity_format(),
        [this] { return read_each(scene().lights, targets(), [](const Light& l) { return double(l.intensity); }); },
        [this](double value) { return write([value](Light& l) { l.intensity = float(value); }); });
    add_number(
        tr("Flux"), flux_format(),
        [this] { return read_lamps([](const Light& l) { return l.kind != Light::Kind::Directional; }, flux_of); },
        [this](double value) {
            return write([value](Light& l) {
                const double one = double(luminance(l.color)) * solid_angle_of(l); // lumen of a candela
                l.intensity = one > 0.0 ? float(value / one) : l.intensity;
            });
        });
    add_number(
        tr("Dimming"), dimming_format(),
        [this] {
            return read_lamps([](const Light& l) { return light_distribution(l) != nullptr; },
                              [](const Light& l) { return double(l.intensity) / double(l.photometry->peak()); });
        },
        [this](double value) {
            return write([value](Light& l) { l.intensity = float(value * double(l.photometry->peak())); });
        });
    photometry_ = new PhotometryBox;
    connect(photometry_, &PhotometryBox::choose, this, [this] { Q_EMIT choose_photometry(targets()); });
    connect(photometry_, &PhotometryBox::remove, this,
            [this] { apply(set_lamp_photometry(scene(), targets(), nullptr), tr("Remove photometry")); });
    add_row(tr("Photometry"), photometry_->buttons(), [this] {
        return !read_lamps([](const Light& l) { return l.kind != Light::Kind::Directional; }, flux_of).empty();
    });
    add_row(QString(), photometry_);
    const auto only = [this](Light::Kind kind, auto get) {
        std::vector<double> values;
        for (const LightId id : targets()) {
            const Light& light = *scene().lights.find(id);
            if (light.kind != kind || light_distribution(light) != nullptr) {
                return std::vector<double>{};
            }
            values.push_back(get(light));
        }
        return values;
    };
    // glTF wants 0 <= inner < outer <= 90 degrees; the fields speak of the full angle, as luminaire catalogues do.
    NumberFormat cone = NumberFormat::angle();
    cone.minimum = 0;
    cone.maximum = 180;
    add_number(
        tr("Beam angle"), cone,
        [only] { return only(Light::Kind::Spot, [](const Light& l) { return degrees_from_radians(2 * l.inner_cone); }); },
        [this](double value) {
            return write([value](Light& l) {
                l.inner_cone = float(radians_from_degrees(value / 2));
                l.outer_cone = std::max(l.outer_cone, std::min(l.inner_cone + 0.01F, kPi / 2));
                l.inner_cone = std::min(l.inner_cone, l.outer_cone - 0.001F);
            });
        });
    cone.minimum = 0.2;
    add_number(
        tr("Outer angle"), cone,
        [only] { return only(Light::Kind::Spot, [](const Light& l) { return degrees_from_radians(2 * l.outer_cone); }); },
        [this](double value) {
            return write([value](Light& l) {
                l.outer_cone = float(radians_from_degrees(value / 2));
                l.inner_cone = std::min(l.inner_cone, l.outer_cone - 0.001F);
            });
        });
    NumberFormat diameter = NumberFormat::angle();
    diameter.minimum = 0;
    diameter.maximum = 90;
    diameter.step = 0.1;
    add_number(
        tr("Angular diameter"), diameter,
        [only] { return only(Light::Kind::Directional, [](const Light& l) { return double(l.angular_diameter_degrees); }); },
        [this](double value) { return write([value](Light& l) { l.angular_diameter_degrees = float(value); }); });
}

std::vector<LightId> LightSection::targets() const {
    std::vector<LightId> lights;
    for (const NodeId id : document().selection()->nodes()) {
        const LightId light = scene().nodes.find(id)->light;
        if (scene().lights.contains(light) && std::find(lights.begin(), lights.end(), light) == lights.end()) {
            lights.push_back(light);
        }
    }
    return lights;
}

std::vector<double> LightSection::read_lamps(const std::function<bool(const Light&)>& fits,
                                             const std::function<double(const Light&)>& get) const {
    std::vector<double> values;
    for (const LightId id : targets()) {
        const Light& light = *scene().lights.find(id);
        if (!fits(light)) {
            return {};
        }
        values.push_back(get(light));
    }
    return values;
}

bool LightSection::has_target() const { return !targets().empty(); }

void LightSection::refresh_more() {
    const std::vector<LightId> lights = targets();
    const bool suns = std::all_of(lights.begin(), lights.end(),
                                  [this](LightId id) { return scene().lights.find(id)->kind == Light::Kind::Directional; });
    UnitSet units;
    if (suns) {
        units.units = {{"lx", 1.0}, {"lux", 1.0}, {"klx", 1000.0}};
    } else {
        units = intensity_format().units;
    }
    intensity_->set_suffix(suns ? tr(" lx") : tr(" cd"), units);
    std::vector<Photometry> files;
    for (const LightId id : lights) {
        files.push_back(scene().lights.find(id)->photometry);
    }
    photometry_->set(files);
}

SceneEdit LightSection::write(const std::function<void(Light&)>& change) const {
    std::vector<SceneEdit> edits;
    for (const LightId id : targets()) {
        Light light = *scene().lights.find(id);
        change(light);
        edits.push_back(SceneEdit{SetResource<Light>{id, std::move(light)}});
    }
    return as_one(std::move(edits));
}

CameraSection::CameraSection(Document& document) : Section(tr("Camera"), document) {
    NumberFormat angle = NumberFormat::angle();
    angle.minimum = 1;
    angle.maximum = 170;
    add_number(
        tr("Field of view"), angle,
        [this] {
            std::vector<double> values;
            for (const CameraId id : targets()) {
                const Camera& camera = *scene().cameras.find(id);
                if (!camera.perspective) {
                    return std::vector<double>{};
                }
                values.push_back(degrees_from_radians(double(camera.yfov)));
            }
            return values;
        },
        [this](double value) { return write([value](Camera& c) { c.yfov = float(radians_from_degrees(value)); }); });
    add_number(
        tr("View height"), NumberFormat::length(1e-3),
        [this] {
            std::vector<double> values;
            for (const CameraId id : targets()) {
                const Camera& camera = *scene().cameras.find(id);
                if (camera.perspective) {
                    return std::vector<double>{};
                }
                values.push_back(2.0 * double(camera.ymag));
            }
            return values;
        },
        [this](double value) { return write([value](Camera& c) { c.ymag = float(value / 2); }); });
    NumberFormat stops = NumberFormat::plain(-20, 20, 2, tr(" EV"));
    stops.step = 1.0 / 3.0;
    add_number(
        tr("Exposure"), stops,
        [this] { return read_each(scene().cameras, targets(), [](const Camera& c) { return double(c.exposure_ev); }); },
        [this](double value) { return write([value](Camera& c) { c.exposure_ev = float(value); }); });
    auto* look = new QPushButton(tr("Look Through"));
    look->setToolTip(tr("Show what this camera sees"));
    connect(look, &QPushButton::clicked, this, [this] { Q_EMIT look_through(Section::document().selection()->active()); });
    add_row(QString(), look, [this] {
        const Node* node = scene().nodes.find(Section::document().selection()->active());
        return node != nullptr && scene().cameras.contains(node->camera);
    });
}

std::vector<CameraId> CameraSection::targets() const {
    std::vector<CameraId> cameras;
    for (const NodeId id : document().selection()->nodes()) {
        const CameraId camera = scene().nodes.find(id)->camera;
        if (scene().cameras.contains(camera) && std::find(cameras.begin(), cameras.end(), camera) == cameras.end()) {
            cameras.push_back(camera);
        }
    }
    return cameras;
}

bool CameraSection::has_target() const { return !targets().empty(); }

SceneEdit CameraSection::write(const std::function<void(Camera&)>& change) const {
    std::vector<SceneEdit> edits;
    for (const CameraId id : targets()) {
        Camera camera = *scene().cameras.find(id);
        change(camera);
        edits.push_back(SceneEdit{SetResource<Camera>{id, std::move(camera)}});
    }
    return as_one(std::move(edits));
}

} // namespace atrium::ui
