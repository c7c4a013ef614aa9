#include "engine/radiosity/sky_light.h"

#include "engine/base/rng.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kMostlyFree = 0.93F; // of what is seen through the clearest place of a window

bool sees(const SkyRay& ray) { return ray.through.x > 0.0F || ray.through.y > 0.0F || ray.through.z > 0.0F; }

// Looks closer until the light is certain enough or the rays are spent.
template <class Look>
void look_closer(EdgeGrid& grid, std::size_t spent, float light, float enough, std::size_t rays, const Look& look) {
    while (true) {
        if (grid.wanted().empty()) {
            if (grid.edge_cells() == 0 || !grid.divisible() || light * light * grid.uncertainty() <= enough ||
                spent + 3 * grid.edge_cells() > rays) {
                return;
            }
            grid.divide(false);
        }
        spent += grid.wanted().size();
        if (spent > rays) {
            return;
        }
        look();
    }
}

} // namespace

SkyLight::SkyLight(const Rgb& radiance, const RayScene& rays, const RunContext& context) : rays_(rays), radiance_(radiance) {
    if (empty()) {
        return;
    }
    windows_ = pane_windows(rays);
    SkyOpenings found = find_sky_openings(rays, context);
    first_opening_ = windows_.size();
    // A hole that a pane fills, before or behind it, is the pane's.
    std::copy_if(found.windows.begin(), found.windows.end(), std::back_inserter(windows_), [this](const SkyWindow& o) {
        const float size = glm::length(o.corners[2] - o.corners[0]);
        return std::none_of(windows_.begin(), windows_.begin() + std::ptrdiff_t(first_opening_), [&](const SkyWindow& pane) {
            const vec3 centre = 0.5F * (pane.corners[0] + pane.corners[2]);
            const float height = glm::dot(o.normal, centre - o.corners[0]);
            return std::abs(height) < 0.5F * size &&
                   std::isfinite(o.crossing(centre - o.normal * (height + size), o.normal));
        });
    });
    elsewhere_ = found.elsewhere;
}

DirectSample SkyLight::irradiance(const vec3& point, const vec3& normal, unsigned sky_rays) const {
    DirectSample out;
    if (empty() || sky_rays == 0) {
        return out;
    }
    if (!windows_.empty()) {
        add_windows(point, normal, sky_rays, out);
    }
    if (elsewhere_) {
        add_elsewhere(point, normal, sky_rays, out);
    }
    return out;
}

std::size_t SkyLight::first_opening(const vec3& point, const vec3& direction) const {
    float nearest = std::numeric_limits<float>::infinity();
    std::size_t first = kNone;
    for (std::size_t i = first_opening_; i < windows_.size(); ++i) {
        const float t = windows_[i].crossing(point, direction);
        if (t < nearest) {
            nearest = t;
            first = i;
        }
    }
    return first;
}

void SkyLight::add_windows(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const {
    struct Look {
        std::size_t window;
        float factor; // of the window and of those it stands for
        WindowPoints points;
        std::size_t traced;
    };
    thread_local std::vector<float> factors;
    thread_local std::vector<Look> looks;
    thread_local std::vector<EdgeGrid> grids; // of looks; kept for their memory
    factors.assign(windows_.size(), 0.0F);
    looks.clear();
    float sum = 0.0F;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        factors[i] = windows_[i].form_factor(point, normal);
        sum += factors[i];
    }
    Rgb seen(0.0F);
    float uncertain = 0.0F;
    for (std::size_t i = 0; i < windows_.size(); ++i) {
        if (!(factors[i] > 1e-5F)) {
            continue;
        }
        // Of the many weak windows that a house has, some stand for all. Every window has its fixed number, so neighbouring
        // points pick the same ones.
        const float wanted = factors[i] / sum * float(sky_rays);
        float stands_for = 1.0F;
        if (wanted < 2.0F) {
            const float chance = unit_float(std::uint32_t(hash64(i + 1) >> 32));
            if (chance >= 0.5F * wanted) {
                continue;
            }
            stands_for = 2.0F / wanted;
        }
        Look& look = looks.emplace_back(Look{i, factors[i] * stands_for, WindowPoints(windows_[i], point, normal), 0});
        grids.resize(std::max(grids.size(), looks.size()));
        EdgeGrid& grid = grids[looks.size() - 1];
        const unsigned size = wanted < 8.0F ? 1 : wanted < 128.0F ? 2 : 3;
        grid.start(size, size, false);
        look.traced = grid.wanted().size();
        look_through(i, look.points, point, grid);
        seen += look.factor * grid.mean_seen();
        uncertain += grid.edge_cells() > 0 ? look.factor : 0.0F;
    }
    const Rgb whole = radiance_ * kPi;
    const float all = luminance(whole * seen);
    for (std::size_t k = 0; k < looks.size(); ++k) {
        Look& l = looks[k];
        EdgeGrid& grid = grids[k];
        const float light = luminance(whole) * l.factor;
        // Where the first few disagree, as many as its share of the rays allows look everywhere: thin things, such as bars
        // and frames, are met in fair numbers only by rays that are not led by those met before.
        const float share = float(sky_rays) * l.factor / std::max(uncertain, 1e-9F);
        while (grid.edge_cells() > 0 && grid.divisible() && 3.0F * float(grid.cell_count()) <= share) {
            grid.divide(true);
            l.traced += grid.wanted().size();
            look_through(l.window, l.points, point, grid);
        }
        // What hides more than a little has an edge worth following. Each may be uncertain by its share of the whole's
        // variance.
        if (max_component(grid.mean_seen()) < kMostlyFree * grid.most_seen()) {
            const float enough = 0.01F / float(sky_rays) * all * luminance(whole * grid.mean_seen()) * l.factor;
            look_closer(grid, l.traced, light, enough, l.traced + std::size_t(share),
                        [&] { look_through(l.window, l.points, point, grid); });
        }
        out.irradiance += whole * l.factor * grid.mean_seen();
        out.variance += light * light * grid.uncertainty();
    }
}

void SkyLight::look_through(std::size_t window, const WindowPoints& points, const vec3& from, EdgeGrid& grid) const {
    thread_local std::vector<vec3> directions;
    thread_local std::vector<float> distances, weights;
    thread_local std::vector<SkyRay> rays;
    thread_local std::vector<Rgb> seen;
    directions.clear();
    distances.clear();
    weights.clear();
    for (const vec2& u : grid.wanted()) {
        const WindowPoints::Place place = points.at(u);
        weights.push_back(place.weight);
        if (place.weight > 0.0F) {
            directions.push_back(place.direction);
            distances.push_back(place.distance);
        }
    }
    rays.resize(directions.size());
    rays_.look_at_sky(from, directions, rays);
    seen.assign(weights.size(), Rgb(0.0F));
    for (std::size_t i = 0, k = 0; i < weights.size(); ++i) {
        if (!(weights[i] > 0.0F)) {
            continue;
        }
        // What crosses a pane is the first pane's; what crosses none but an opening is the first opening's.
        bool own = sees(rays[k]);
        if (own && windows_[window].opening) {
            const std::size_t owner = first_opening(from, directions[k]); // none: on its very rim
            own = !std::isfinite(rays[k].first_pane) && (owner == window || owner == kNone);
        } else if (own) {
            own = rays[k].first_pane >= distances[k] * (1.0F - 1e-3F) - 1e-4F;
        }
        seen[i] = own ? rays[k].through : Rgb(0.0F);
        ++k;
    }
    grid.set(seen, weights);
}

void SkyLight::look_elsewhere(const vec3& point, const vec3& normal, EdgeGrid& grid) const {
    thread_local std::vector<vec3> directions;
    thread_local std::vector<float> weights;
    thread_local std::vector<SkyRay> rays;
    thread_local std::vector<Rgb> seen;
    vec3 t;
    vec3 b;
    make_frame(normal, t, b);
    directions.clear();
    for (const vec2& u : grid.wanted()) {
        // Cosine weighted: all cells are worth the same.
        const float r = std::sqrt(u.y), angle = 2.0F * kPi * u.x;
        directions.push_back(
            glm::normalize((r * std::cos(angle)) * t + (r * std::sin(angle)) * b + std::sqrt(1.0F - u.y) * normal));
    }
    rays.resize(directions.size());
    rays_.look_at_sky(point, directions, rays);
    weights.assign(directions.size(), 1.0F);
    seen.assign(directions.size(), Rgb(0.0F));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        // What a window lets through is counted with the window.
        const bool free = sees(rays[i]) && !std::isfinite(rays[i].first_pane);
        seen[i] = free && first_opening(point, directions[i]) == kNone ? rays[i].through : Rgb(0.0F);
    }
    grid.set(seen, weights);
}

void SkyLight::add_elsewhere(const vec3& point, const vec3& normal, unsigned sky_rays, DirectSample& out) const {
    thread_local EdgeGrid grid;
    const unsigned size = sky_rays < 160 ? 2 : 3;
    grid.start(size, size + 1, true);
    const std::size_t traced = grid.wanted().size();
    look_elsewhere(point, normal, grid);
    const Rgb whole = radiance_ * kPi;
    const float light = luminance(whole);
    const float seen = luminance(whole * grid.mean_seen());
    const float enough = 0.01F / float(sky_rays) * (luminance(out.irradiance) + seen) * seen;
    look_closer(grid, traced, light, enough, std::size_t(4) * sky_rays, [&] { look_elsewhere(point, normal, grid); });
    out.irradiance += whole * grid.mean_seen();
    out.variance += light * light * grid.uncertainty();
}

} // namespace atrium
