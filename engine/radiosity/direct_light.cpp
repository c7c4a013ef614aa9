#include "engine/radiosity/direct_light.h"

#include "engine/base/rng.h"
#include "engine/geometry/form_factor.h"
#include "engine/radiosity/disc_pattern.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kSunScouts = 8; // rays towards the sun that may stand for all where they agree
constexpr unsigned kPanePoints = 64;  // points on each pane that are kept ready

// Point k of the pattern on pane i: of a pattern of its own, in the plane of the triangle.
vec3 make_pane_point(const std::array<vec3, 3>& pane, std::size_t i, unsigned k) {
    vec2 u = sobol_owen2(k, 0, std::uint32_t(0x5B7U + i));
    if (u.x + u.y > 1.0F) {
        u = vec2(1.0F) - u;
    }
    return pane[0] + (pane[1] - pane[0]) * u.x + (pane[2] - pane[0]) * u.y;
}

} // namespace

DirectLight::DirectLight(const Scene& scene, const RayScene& rays) : rays_(rays) {
    for (const NodeId id : scene.in_tree_order()) {
        const Node& node = *scene.nodes.find(id);
        const Light* light = scene.lights.find(node.light);
        if (light == nullptr || !light->enabled || !scene.shown(id) || !(light->intensity > 0.0F) ||
            !(max_component(light->color) > 0.0F)) {
            continue;
        }
        const dmat4 world = scene.world_matrix(id);
        const dvec3 axis = -dvec3(world[2]);
        const double length = glm::length(axis);
        lights_.push_back(
            {*light, id, vec3(dvec3(world[3]) - rays.origin()), length > 0.0 ? vec3(axis / length) : vec3(0, 0, -1)});
    }
    sky_radiance_ = scene.environment.sky_radiance;
    sky_ = max_component(sky_radiance_) > 0.0F;
    for (std::uint32_t s = 0; sky_ && s < rays.surfaces().size(); ++s) {
        if (rays.surfaces()[s].pane) {
            for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
                panes_.push_back(rays.triangle(s, t));
            }
        }
    }
    pane_points_.reserve(panes_.size() * kPanePoints);
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        const auto& p = panes_[i];
        pane_normals_.push_back(glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])));
        for (unsigned k = 0; k < kPanePoints; ++k) {
            pane_points_.push_back(make_pane_point(p, i, k));
        }
    }
}

DirectSample DirectLight::irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const {
    DirectSample out = lamps_irradiance(point, normal, sun_rays);
    const DirectSample sky = sky_irradiance(point, normal, sky_rays);
    out.irradiance += sky.irradiance;
    out.variance += sky.variance;
    return out;
}

DirectSample DirectLight::lamps_irradiance(const vec3& point, const vec3& normal, unsigned sun_rays) const {
    DirectSample out;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        if (light.kind == Light::Kind::Directional) {
            add_sun(placed, point, normal, sun_rays, out);
            continue;
        }
        const vec3 d = placed.position - point;
        const float distance2 = glm::dot(d, d);
        const float distance = std::sqrt(distance2);
        const float cosine = distance > 0.0F ? glm::dot(normal, d) / distance : 0.0F;
        float candela = light.intensity;
        if (light.kind == Light::Kind::Spot && distance > 0.0F) {
            candela *= spot_falloff(light, -glm::dot(d, placed.axis) / distance);
        }
        if (cosine <= 0.0F || candela <= 0.0F) {
            continue;
        }
        out.irradiance += light.color * (candela * cosine / distance2) * rays_.transmittance(point, placed.position);
    }
    return out;
}

DirectSample DirectLight::sky_irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const {
    DirectSample out;
    if (sky_ && sky_rays > 0) {
        if (!panes_.empty()) {
            add_sky_through_panes(point, normal, sky_rays, out);
        }
        add_open_sky(point, normal, std::max(sky_rays / 3, 16U), out);
    }
    return out;
}

void DirectLight::add_sun(const PlacedLight& sun, const vec3& point, const vec3& normal, unsigned sun_rays,
                          DirectSample& out) const {
    const Rgb full = sun.light.color * sun.light.intensity;
    const float radius = std::tan(float(radians_from_degrees(0.5 * sun.light.angular_diameter_degrees)));
    const float cosine = -glm::dot(normal, sun.axis);
    if (!(radius > 0.0F)) {
        if (cosine > 0.0F) {
            out.irradiance += full * cosine * rays_.transmittance_to_infinity(point, -sun.axis);
        }
        return;
    }
    if (cosine < -radius) {
        return; // wholly below the horizon
    }
    const bool whole = cosine > 1.5F * radius; // the disc stands above the horizon
    const std::vector<vec2>& disc = disc_pattern(std::max(sun_rays, 1U));
    vec3 t;
    vec3 b;
    make_frame(-sun.axis, t, b);
    Rgb sum(0.0F), least(1.0F), most(0.0F);
    float lit = 0.0F;
    std::size_t traced = 0;
    for (; traced < disc.size(); ++traced) {
        // Where the first few rays all say the same, so would the others: only in penumbrae are they worth tracing.
        if (traced == kSunScouts && whole && max_component(most - least) <= 0.01F) {
            break;
        }
        const vec2 offset = radius * disc[traced];
        const vec3 to_sun = glm::normalize(offset.x * t + offset.y * b - sun.axis);
        const float c = whole ? cosine : glm::dot(normal, to_sun);
        const Rgb through = c > 0.0F ? rays_.transmittance_to_infinity(point, to_sun) : Rgb(0.0F);
        least = glm::min(least, through);
        most = glm::max(most, through);
        sum += through * std::max(c, 0.0F);
        lit += max_component(through) > 0.0F ? 1.0F : 0.0F;
    }
    const auto n = float(traced);
    out.irradiance += full * sum / n;
    if (lit > 0.0F && lit < n) {
        // Of n even points about 2 sqrt(n p (1 - p)) stand for pieces of the disc that an edge cuts: each is off by a
        // variance of 1/12 of its light squared.
        const float p = lit / n;
        const float light = luminance(full) * std::max(cosine, radius);
        out.variance += light * light * 2.0F * std::sqrt(p * (1.0F - p)) / (12.0F * n * std::sqrt(n));
    }
}

namespace {

/// Cells of the cosine-weighted hemisphere: rings of equal r^2 and sectors of equal angle, all of one weight, halved per
/// level both ways. Holds what each cell's ray saw of the sky.
struct SkyGrid {
    int rings = 0;
    int sectors = 0;
    std::vector<Rgb> seen;
    std::vector<std::uint8_t> known; ///< 1 = a ray of its own, 0 = its parent's answer
    std::vector<std::uint8_t> edge;  ///< 1 = a neighbour sees differently

    SkyGrid(int r, int s) : rings(r), sectors(s), seen(std::size_t(r * s)), known(std::size_t(r * s), 0), edge(known) {}
    [[nodiscard]] std::size_t at(int ring, int sector) const {
        return std::size_t(ring * sectors + (sector + sectors) % sectors);
    }
    [[nodiscard]] vec3 direction(int ring, int sector, const vec3& t, const vec3& b, const vec3& n) const {
        const float u = (float(ring) + 0.5F) / float(rings);
        const float angle = 2.0F * kPi * (float(sector) + 0.5F) / float(sectors);
        const float r = std::sqrt(u);
        return glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b + std::sqrt(1.0F - u) * n);
    }
    // A neighbour that sees differently: somewhere between lies an edge.
    [[nodiscard]] bool on_edge(int ring, int sector) const {
        const bool sees = max_component(seen[at(ring, sector)]) > 0.0F;
        const auto differs = [&](int r, int s) {
            return r >= 0 && r < rings && (max_component(seen[at(r, s)]) > 0.0F) != sees;
        };
        return differs(ring - 1, sector) || differs(ring + 1, sector) || differs(ring, sector - 1) ||
               differs(ring, sector + 1);
    }
};

} // namespace

void DirectLight::add_open_sky(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const {
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    const int base = std::max(2, int(std::lround(std::sqrt(float(sky_rays) / 4.0F))));
    SkyGrid grid(base, 4 * base);
    std::fill(grid.known.begin(), grid.known.end(), std::uint8_t(1));
    std::vector<std::size_t> cells;
    std::vector<vec3> directions;
    std::vector<SkyRay> rays;
    for (int level = 0;; ++level) {
        cells.clear();
        directions.clear();
        for (int ring = 0; ring < grid.rings; ++ring) {
            for (int sector = 0; sector < grid.sectors; ++sector) {
                if (grid.known[grid.at(ring, sector)] != 0) {
                    cells.push_back(grid.at(ring, sector));
                    directions.push_back(grid.direction(ring, sector, t, b, normal));
                }
            }
        }
        rays.resize(cells.size());
        rays_.look_at_sky(point, directions, rays);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            // What a pane lets through is counted with the pane.
            grid.seen[cells[i]] = std::isfinite(rays[i].first_pane) ? Rgb(0.0F) : rays[i].through;
        }
        float edges = 0.0F;
        for (int ring = 0; ring < grid.rings; ++ring) {
            for (int sector = 0; sector < grid.sectors; ++sector) {
                grid.edge[grid.at(ring, sector)] = grid.on_edge(ring, sector) ? 1 : 0;
                edges += float(grid.edge[grid.at(ring, sector)]);
            }
        }
        if (level == 2 || edges == 0.0F) {
            Rgb sum(0.0F);
            for (const Rgb& s : grid.seen) {
                sum += s;
            }
            const auto count = float(grid.seen.size());
            const Rgb whole = sky_radiance_ * kPi;
            out.irradiance += whole * sum / count;
            // A cell on an edge is seen to some share between none and all: variance 1/12 of its light squared each.
            const float cell = luminance(whole) / count;
            out.variance += edges * cell * cell / 12.0F;
            return;
        }
        SkyGrid finer(2 * grid.rings, 2 * grid.sectors);
        for (int ring = 0; ring < finer.rings; ++ring) {
            for (int sector = 0; sector < finer.sectors; ++sector) {
                const std::size_t child = finer.at(ring, sector), parent = grid.at(ring / 2, sector / 2);
                finer.seen[child] = grid.seen[parent];
                finer.known[child] = grid.edge[parent];
            }
        }
        grid = std::move(finer);
    }
}

void DirectLight::add_sky_through_panes(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const {
    thread_local std::vector<float> factors;
    factors.assign(panes_.size(), 0.0F);
    float sum = 0.0F;
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        factors[i] = float(form_factor_to_polygon(point, normal, panes_[i]));
        sum += factors[i];
    }
    const Rgb whole = sky_radiance_ * kPi;
    for (std::size_t i = 0; i < panes_.size(); ++i) {
        if (!(factors[i] > 1e-5F)) {
            continue;
        }
        // Strong panes get rays by their share; of the many weak ones that a house has, some stand for all. Every pane has
        // its fixed number, so neighbouring points pick the same ones.
        const float wanted = factors[i] / sum * float(sky_rays);
        float stands_for = 1.0F;
        if (wanted < 2.0F) {
            const float chance = unit_float(std::uint32_t(hash64(i + 1) >> 32));
            if (chance >= 0.5F * wanted) {
                continue;
            }
            stands_for = 2.0F / wanted;
        }
        const auto count = unsigned(std::exp2(std::round(std::log2(std::max(wanted, 2.0F)))));
        const PaneView view = look_through(i, point, normal, count);
        if (view.weights > 0.0F) {
            out.irradiance += whole * (factors[i] * stands_for / view.weights) * view.seen;
            const float n = view.points;
            if (view.clear > 0.0F && view.clear < n) {
                const float light = luminance(whole) * factors[i] * stands_for;
                out.variance +=
                    light * light * (view.clear + 1.0F) * (n - view.clear + 1.0F) / ((n + 2.0F) * (n + 2.0F) * n);
            }
        }
    }
}

DirectLight::PaneView DirectLight::look_through(std::size_t pane, const vec3& point, const vec3& normal,
                                                unsigned count) const {
    PaneView view;
    thread_local std::vector<vec3> directions;
    thread_local std::vector<vec2> weight_and_distance;
    thread_local std::vector<SkyRay> rays;
    directions.clear();
    weight_and_distance.clear();
    for (unsigned k = 0; k < count; ++k) {
        const vec3 y = k < kPanePoints ? pane_points_[pane * kPanePoints + k] : make_pane_point(panes_[pane], pane, k);
        const vec3 d = y - point;
        const float distance2 = glm::dot(d, d);
        const float cosine = glm::dot(d, normal);
        if (!(distance2 > 0.0F) || cosine <= 0.0F) {
            continue;
        }
        const float distance = std::sqrt(distance2);
        directions.push_back(d / distance);
        weight_and_distance.emplace_back(cosine * std::abs(glm::dot(d, pane_normals_[pane])) / (distance2 * distance2),
                                         distance);
    }
    rays.resize(directions.size());
    rays_.look_at_sky(point, directions, rays);
    for (std::size_t k = 0; k < rays.size(); ++k) {
        const float weight = weight_and_distance[k].x, distance = weight_and_distance[k].y;
        view.weights += weight;
        view.points += 1.0F;
        // Where another pane stands before this one, the light is that one's.
        if (max_component(rays[k].through) > 0.0F && rays[k].first_pane >= distance * (1.0F - 1e-3F) - 1e-4F) {
            view.seen += rays[k].through * weight;
            view.clear += 1.0F;
        }
    }
    return view;
}

double DirectLight::emitted_flux() const {
    double flux = 0.0;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        const double candela = double(luminance(light.color)) * light.intensity;
        if (light.kind == Light::Kind::Point) {
            flux += 4.0 * kPiD * candela;
        } else if (light.kind == Light::Kind::Spot) {
            // Integral of the squared falloff over the cone: 2 pi I [(1 - cos i) + (cos i - cos o) / 3].
            const double inner = std::cos(light.inner_cone);
            const double outer = std::cos(light.outer_cone);
            flux += 2.0 * kPiD * candela * ((1.0 - inner) + (inner - outer) / 3.0);
        }
    }
    return flux;
}

} // namespace atrium
