#include "engine/radiosity/direct_light.h"

#include "engine/base/rng.h"
#include "engine/geometry/form_factor.h"

#include <algorithm>

namespace atrium {

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
}

DirectSample DirectLight::irradiance(const vec3& point, const vec3& normal, unsigned sun_rays, unsigned sky_rays) const {
    DirectSample out;
    for (const PlacedLight& placed : lights_) {
        const Light& light = placed.light;
        if (light.kind == Light::Kind::Directional) {
            const float radius = std::tan(float(radians_from_degrees(0.5 * light.angular_diameter_degrees)));
            const unsigned n = radius > 0.0F ? std::max(sun_rays, 1U) : 1U;
            vec3 t;
            vec3 b;
            make_frame(-placed.axis, t, b);
            const Rgb full = light.color * light.intensity;
            Rgb sum(0.0F);
            float lit = 0.0F;
            for (unsigned i = 0; i < n; ++i) {
                vec3 to_sun = -placed.axis;
                if (n > 1) {
                    // Fermat spiral: even over the disc for any n.
                    const float r = radius * std::sqrt((float(i) + 0.5F) / float(n));
                    const float angle = 2.39996323F * float(i);
                    to_sun = glm::normalize(to_sun + (r * std::cos(angle)) * t + (r * std::sin(angle)) * b);
                }
                const float cosine = glm::dot(normal, to_sun);
                if (cosine > 0.0F) {
                    const Rgb through = rays_.transmittance_to_infinity(point, to_sun);
                    sum += through * cosine;
                    lit += max_component(through) > 0.0F ? 1.0F : 0.0F;
                }
            }
            const Rgb e = full * sum / float(n);
            out.irradiance += e;
            if (n > 1) {
                const float share = (lit + 1.0F) * (float(n) - lit + 1.0F) / ((float(n) + 2.0F) * (float(n) + 2.0F));
                const float whole = luminance(full) * std::max(glm::dot(normal, -placed.axis), 0.0F);
                out.variance += lit == 0.0F || lit == float(n) ? 0.0F : whole * whole * share / float(n);
            }
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
    if (sky_ && sky_rays > 0) {
        if (!panes_.empty()) {
            add_sky_through_panes(point, normal, sky_rays, out);
        }
        add_open_sky(point, normal, std::max(sky_rays / 3, 16U), out);
    }
    return out;
}

namespace {

/// Cells of the cosine-weighted hemisphere: rings of equal r^2 and sectors of equal angle, all of one weight, halved per
/// level both ways. Holds what each cell's ray saw of the sky.
struct SkyGrid {
    int rings = 0;
    int sectors = 0;
    std::vector<Rgb> seen;
    std::vector<std::uint8_t> known; ///< 1 = a ray of its own, 0 = its parent's answer

    SkyGrid(int r, int s) : rings(r), sectors(s), seen(std::size_t(r * s)), known(std::size_t(r * s), 0) {}
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
    for (int level = 0;; ++level) {
        for (int ring = 0; ring < grid.rings; ++ring) {
            for (int sector = 0; sector < grid.sectors; ++sector) {
                if (grid.known[grid.at(ring, sector)] != 0) {
                    const vec3 direction = grid.direction(ring, sector, t, b, normal);
                    Rgb through = rays_.transmittance_to_infinity(point, direction);
                    if (!panes_.empty() && max_component(through) > 0.0F && rays_.first_pane(point, direction)) {
                        through = Rgb(0.0F); // counted with the pane
                    }
                    grid.seen[grid.at(ring, sector)] = through;
                }
            }
        }
        float edges = 0.0F;
        SkyGrid finer(2 * grid.rings, 2 * grid.sectors);
        for (int ring = 0; ring < grid.rings; ++ring) {
            for (int sector = 0; sector < grid.sectors; ++sector) {
                const bool edge = grid.on_edge(ring, sector);
                edges += edge ? 1.0F : 0.0F;
                for (int k = 0; k < 4; ++k) {
                    const std::size_t child = finer.at(2 * ring + k / 2, 2 * sector + k % 2);
                    finer.seen[child] = grid.seen[grid.at(ring, sector)];
                    finer.known[child] = edge ? 1 : 0;
                }
            }
        }
        if (level == 2 || edges == 0.0F) {
            Rgb sum(0.0F);
            for (const Rgb& s : grid.seen) {
                sum += s;
            }
            const auto cells = float(grid.seen.size());
            const Rgb whole = sky_radiance_ * kPi;
            out.irradiance += whole * sum / cells;
            // A cell on an edge is seen to some share between none and all: variance 1/12 of its light squared each.
            const float cell = luminance(whole) / cells;
            out.variance += edges * cell * cell / 12.0F;
            return;
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
        const auto& pane = panes_[i];
        const vec3 pane_normal = glm::normalize(glm::cross(pane[1] - pane[0], pane[2] - pane[0]));
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
        Rgb seen(0.0F);
        float weights = 0.0F;
        float clear = 0.0F;
        for (unsigned k = 0; k < count; ++k) {
            vec2 u = sobol_owen2(k, 0, std::uint32_t(0x5B7U + i));
            if (u.x + u.y > 1.0F) {
                u = vec2(1.0F) - u;
            }
            const vec3 y = pane[0] + (pane[1] - pane[0]) * u.x + (pane[2] - pane[0]) * u.y;
            const vec3 d = y - point;
            const float distance = glm::length(d);
            const float cosine = glm::dot(d, normal);
            if (!(distance > 0.0F) || cosine <= 0.0F) {
                continue;
            }
            const float weight = cosine * std::abs(glm::dot(d, pane_normal)) / (distance * distance * distance * distance);
            weights += weight;
            const vec3 direction = d / distance;
            const Rgb through = rays_.transmittance_to_infinity(point, direction);
            if (!(max_component(through) > 0.0F)) {
                continue;
            }
            const Hit first = rays_.first_pane(point, direction);
            if (first && first.t < distance * (1.0F - 1e-3F) - 1e-4F) {
                continue; // another pane stands before this one
            }
            seen += through * weight;
            clear += 1.0F;
        }
        if (weights > 0.0F) {
            out.irradiance += whole * (factors[i] * stands_for / weights) * seen;
            const auto n = float(count);
            if (clear > 0.0F && clear < n) {
                const float light = luminance(whole) * factors[i] * stands_for;
                out.variance += light * light * (clear + 1.0F) * (n - clear + 1.0F) / ((n + 2.0F) * (n + 2.0F) * n);
            }
        }
    }
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
