#include "ui/viewport/light_meter.h"

#include "ui/viewport/legend.h"

#include <QCoreApplication>

#include <fmt/format.h>

#include <algorithm>

namespace atrium::ui {
namespace {

constexpr double kAbove = 0.002; ///< metres over the surface from which a point looks for it again
constexpr double kMark = 9.0;    ///< logical pixels around a point that count as its mark
constexpr int kPanes = 16;       ///< looked through at most

bool is_glass(const Material& material) {
    const MaterialKind kind = classify(material);
    return kind == MaterialKind::DielectricThin || kind == MaterialKind::DielectricSolid;
}

/// Weights of a triangle's corners at a point in its plane, all in the mesh's coordinates.
vec3 weights_at(const DisplayMesh& mesh, std::size_t first, const dvec3& point) {
    const dvec3 a(mesh.positions[mesh.indices[first]]);
    const dvec3 ab = dvec3(mesh.positions[mesh.indices[first + 1]]) - a;
    const dvec3 ac = dvec3(mesh.positions[mesh.indices[first + 2]]) - a;
    const dvec3 normal = glm::cross(ab, ac);
    const double area2 = glm::dot(normal, normal);
    if (!(area2 > 0.0)) {
        return {1.0F, 0.0F, 0.0F};
    }
    const double v = std::clamp(glm::dot(glm::cross(point - a, ac), normal) / area2, 0.0, 1.0);
    const double w = std::clamp(glm::dot(glm::cross(ab, point - a), normal) / area2, 0.0, 1.0 - v);
    return {float(1.0 - v - w), float(v), float(w)};
}

std::optional<MeterReading> read_hit(const ViewItem& item, const Scene& scene, const Solution& solution,
                                     std::size_t triangle, bool front, const dvec3& local) {
    if (!item.layer || classify(*item.material) != MaterialKind::Diffuse || item.material->unlit ||
        item.layer->irradiance_front.size() < item.mesh->positions.size()) {
        return std::nullopt;
    }
    const bool back = !front && item.layer->has_back();
    const vec3 weight = weights_at(*item.mesh, 3 * triangle, local);
    MeterReading out;
    out.node = item.node;
    out.part = item.part;
    out.light = read_light(scene, solution, *item.layer, *item.material, 3 * triangle, weight, back);
    return out;
}

/// Tells the error that is likely at the place of a reading, where that is known.
void judge(MeterReading& reading, const LocalError* error) {
    if (error != nullptr && !error->empty()) {
        LightReading& light = reading.light;
        light.standard_error = light.illuminance * error->at(reading.point, reading.normal, light.illuminance);
    }
}

QString tr_meter(const char* text) { return QCoreApplication::translate("LightMeter", text); }

QString error_text(double error) {
    return error >= 10.0 ? amount_text(std::round(error)) : QLocale().toString(error, 'g', 2);
}

} // namespace

std::optional<MeterReading> read_along(const ViewScene& view, const Scene& scene, const Solution& solution, const Ray& ray,
                                       const LocalError* error) {
    Ray rest = ray;
    for (int pane = 0; pane < kPanes; ++pane) {
        const auto hit = view.pick(rest);
        if (!hit) {
            return std::nullopt;
        }
        const auto item = std::find_if(view.items().begin(), view.items().end(),
                                       [&](const ViewItem& one) { return one.node == hit->node && one.part == hit->part; });
        if (item == view.items().end()) {
            return std::nullopt;
        }
        if (is_glass(*item->material)) {
            rest.origin = hit->point + rest.direction * 1e-4;
            continue;
        }
        const dvec3 local(glm::inverse(item->world) * dvec4(hit->point, 1.0));
        auto out = read_hit(*item, scene, solution, hit->triangle, hit->front, local);
        if (out) {
            out->point = hit->point;
            out->normal = hit->normal;
            judge(*out, error);
        }
        return out;
    }
    return std::nullopt;
}

QStringList reading_lines(const LightReading& light) {
    QStringList lines;
    lines.append(light.standard_error > 0.0
                     ? tr_meter(QT_TRANSLATE_NOOP("LightMeter", "%1 lx \u00b1 %2"))
                           .arg(amount_text(light.illuminance), error_text(light.standard_error))
                     : tr_meter(QT_TRANSLATE_NOOP("LightMeter", "%1 lx")).arg(amount_text(light.illuminance)));
    lines.append(tr_meter(QT_TRANSLATE_NOOP("LightMeter", "%1 cd/m\u00b2")).arg(amount_text(light.luminance)));
    const double sum = light.direct + light.diffuse + light.caustic;
    if (sum > 0.0) {
        const auto percent = [sum](double part) { return int(std::lround(100.0 * part / sum)); };
        lines.append(tr_meter(QT_TRANSLATE_NOOP("LightMeter", "direct %1 %, diffuse %2 %, caustics %3 %"))
                         .arg(percent(light.direct))
                         .arg(percent(light.diffuse))
                         .arg(percent(light.caustic)));
    }
    return lines;
}

void MeasuringPoints::add(const Scene& scene, const MeterReading& reading) {
    Point point;
    point.number = next_number_++;
    point.node = reading.node;
    point.part = reading.part;
    const dmat4 world = scene.world_matrix(reading.node);
    point.place = dvec3(glm::inverse(world) * dvec4(reading.point, 1.0));
    point.normal = glm::transpose(dmat3(world)) * reading.normal; // normals go by the inverse transpose, back by this
    point.reading = reading;
    points_.push_back(point);
}

void MeasuringPoints::remove(int number) {
    std::erase_if(points_, [number](const Point& point) { return point.number == number; });
}

void MeasuringPoints::read(const ViewScene& view, const Scene& scene, const std::shared_ptr<const Solution>& solution,
                           const LocalError* error) {
    for (Point& point : points_) {
        point.reading.reset();
        const auto item = std::find_if(view.items().begin(), view.items().end(), [&](const ViewItem& one) {
            return one.node == point.node && one.part == point.part;
        });
        if (item == view.items().end() || item->flattened || !solution) {
            continue;
        }
        const dvec3 place(item->world * dvec4(point.place, 1.0));
        const dvec3 normal = glm::normalize(glm::transpose(glm::inverse(dmat3(item->world))) * point.normal);
        const dmat4 inverse = glm::inverse(item->world);
        const dvec3 origin(inverse * dvec4(place + normal * kAbove, 1.0));
        const dvec3 direction(inverse * dvec4(-normal, 0.0));
        const auto hit = item->bvh->nearest(origin, direction, 2.0 * kAbove,
                                            item->material->double_sided ? RaySides::Both : RaySides::Front);
        if (!hit) {
            continue;
        }
        point.reading = read_hit(*item, scene, *solution, hit->triangle, hit->front, origin + direction * hit->t);
        if (point.reading) {
            point.reading->point = place;
            point.reading->normal = normal;
            judge(*point.reading, error);
        }
    }
}

void MeasuringPoints::look(const ViewScene& view, const CameraController& camera) {
    for (Point& point : points_) {
        if (!point.reading) {
            continue;
        }
        const dvec3 way = point.reading->point - camera.eye();
        const double distance = glm::length(way);
        point.hidden = glm::dot(way, point.reading->normal) > 0.0;
        Ray ray{camera.eye(), way / std::max(distance, 1e-9)};
        double left = distance - 0.002 - 0.001 * distance;
        for (int pane = 0; pane < kPanes && !point.hidden && left > 0.0; ++pane) {
            const auto hit = view.pick(ray, left);
            if (!hit) {
                break;
            }
            const auto item = std::find_if(view.items().begin(), view.items().end(), [&](const ViewItem& one) {
                return one.node == hit->node && one.part == hit->part;
            });
            point.hidden = item == view.items().end() || !is_glass(*item->material);
            ray.origin = hit->point + ray.direction * 1e-4;
            left -= hit->distance + 1e-4;
        }
    }
}

const MeasuringPoints::Point* MeasuringPoints::at(const CameraController& camera, const dvec2& position) const {
    const Point* best = nullptr;
    double nearest = kMark;
    for (const Point& point : points_) {
        const auto shown = point.reading ? camera.project(point.reading->point) : std::nullopt;
        if (shown && glm::length(*shown - position) < nearest) {
            nearest = glm::length(*shown - position);
            best = &point;
        }
    }
    return best;
}

std::string MeasuringPoints::csv() const {
    std::string out = "point,x,y,z,nx,ny,nz,E_r,E_g,E_b,E,stderr,on_surface,L,E_direct,E_diffuse,E_caustic\n";
    for (const Point& point : points_) {
        if (point.reading) {
            const MeterReading& r = *point.reading;
            const LightReading& l = r.light;
            out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},1,{},{},{},{}\n", point.number, r.point.x, r.point.y,
                               r.point.z, r.normal.x, r.normal.y, r.normal.z, l.irradiance.r, l.irradiance.g, l.irradiance.b,
                               l.illuminance, l.standard_error, l.luminance, l.direct, l.diffuse, l.caustic);
        }
    }
    return out;
}

} // namespace atrium::ui
