#include "engine/layers/caustic_layer.h"

#include "engine/base/parallel.h"
#include "engine/raycast/light_walk.h"
#include "engine/raycast/scene_charts.h"

#include <algorithm>
#include <map>
#include <unordered_map>

namespace atrium {
namespace {

// Landings that one vertex's light is the mean of, about: fewer are noisy, more are blurred.
constexpr float kSmoothed = 1500.0F;
constexpr std::uint32_t kLandingStride = 1024; // landings between two questions whether to go on

// A vector in the plane of a charted triangle, in chart space.
vec2 to_chart(const std::array<vec3, 3>& p, const std::array<vec2, 3>& uv, const vec3& v) {
    const vec3 e1 = p[1] - p[0];
    const vec3 e2 = p[2] - p[0];
    const float a = glm::dot(e1, e1), b = glm::dot(e1, e2), c = glm::dot(e2, e2);
    const float determinant = a * c - b * b;
    if (!(determinant > 0.0F)) {
        return vec2(0.0F);
    }
    const float v1 = glm::dot(e1, v), v2 = glm::dot(e2, v);
    const float x = (c * v1 - b * v2) / determinant;
    const float y = (a * v2 - b * v1) / determinant;
    return (uv[1] - uv[0]) * x + (uv[2] - uv[0]) * y;
}

// A landing or several close ones together.
struct Deposit {
    vec3 position{0.0F};
    vec3 normal{0.0F};
    Rgb power{0.0F};
    float reach = 0.0F;
};

struct CellHash {
    std::size_t operator()(const ivec3& c) const {
        return std::size_t(c.x) * 73856093U ^ std::size_t(c.y) * 19349663U ^ std::size_t(c.z) * 83492791U;
    }
};
using Cells = std::unordered_map<ivec3, std::vector<std::uint32_t>, CellHash>;

ivec3 cell_of(const vec3& p, float size) {
    const vec3 c = glm::floor(p / size);
    return {int(c.x), int(c.y), int(c.z)};
}

/// Vertices of one side of a layer, and the area that each stands for.
class VertexField {
public:
    VertexField(const SurfaceLayer& layer, const RaySurface& surface, bool back) {
        const DisplayMesh& mesh = *layer.mesh;
        position_.resize(mesh.positions.size());
        normal_.resize(mesh.positions.size());
        area_.assign(mesh.positions.size(), 0.0);
        for (std::size_t i = 0; i < position_.size(); ++i) {
            position_[i] = vec3(dvec3(surface.to_engine * dvec4(dvec3(mesh.positions[i]), 1.0)));
            const dvec3 n = surface.normal_matrix * dvec3(mesh.normals[i]);
            const double length = glm::length(n);
            normal_[i] = length > 0.0 ? vec3(n / length) * (back ? -1.0F : 1.0F) : vec3(0.0F);
        }
        float longest = 0.0F;
        for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
            const std::uint32_t* v = &mesh.indices[t];
            const double third =
                glm::length(dvec3(glm::cross(position_[v[1]] - position_[v[0]], position_[v[2]] - position_[v[0]]))) / 6.0;
            for (std::size_t k = 0; k < 3; ++k) {
                area_[v[k]] += third;
                longest = std::max(longest, glm::length(position_[v[k]] - position_[v[(k + 1) % 3]]));
            }
            total_ += 3.0 * third;
        }
        longest_ = longest;
        light_.assign(position_.size(), dvec3(0.0));
    }

    [[nodiscard]] double area() const { return total_; }
    [[nodiscard]] float longest_edge() const { return longest_; }

    void sort_into_cells(float size) {
        size_ = std::max(size, 1e-6F);
        for (std::uint32_t i = 0; i < position_.size(); ++i) {
            if (area_[i] > 0.0) {
                cells_[cell_of(position_[i], size_)].push_back(i);
            }
        }
    }

    // Power over the vertices around, weighted so that the sum of light times area is the power.
    void add(const Deposit& d) {
        std::vector<std::pair<std::uint32_t, double>> found;
        for (float reach = size_; found.empty() && reach < 64.0F * size_; reach *= 2.0F) {
            collect(d, reach, true, found);
        }
        if (found.empty()) { // nothing near faces its way: the nearest vertex of all
            std::uint32_t nearest = 0;
            float least = std::numeric_limits<float>::infinity();
            for (std::uint32_t i = 0; i < position_.size(); ++i) {
                const float distance = glm::length(position_[i] - d.position);
                if (area_[i] > 0.0 && distance < least) {
                    least = distance;
                    nearest = i;
                }
            }
            found.emplace_back(nearest, 1.0);
        }
        double sum = 0.0;
        for (const auto& [i, w] : found) {
            sum += w * area_[i];
        }
        for (const auto& [i, w] : found) {
            light_[i] += dvec3(d.power) * (w / sum);
        }
    }

    [[nodiscard]] std::vector<Rgb> light() const {
        std::vector<Rgb> out(light_.size());
        std::transform(light_.begin(), light_.end(), out.begin(), [](const dvec3& l) { return Rgb(l); });
        return out;
    }

private:
    void collect(const Deposit& d, float reach, bool facing, std::vector<std::pair<std::uint32_t, double>>& found) const {
        const ivec3 low = cell_of(d.position - vec3(reach), size_);
        const ivec3 high = cell_of(d.position + vec3(reach), size_);
        for (int z = low.z; z <= high.z; ++z) {
            for (int y = low.y; y <= high.y; ++y) {
                for (int x = low.x; x <= high.x; ++x) {
                    const auto at = cells_.find({x, y, z});
                    if (at == cells_.end()) {
                        continue;
                    }
                    for (const std::uint32_t i : at->second) {
                        const vec3 v = position_[i] - d.position;
                        const float q = glm::dot(v, v) / (reach * reach);
                        if (q < 1.0F && (!facing || glm::dot(normal_[i], d.normal) > 0.5F)) {
                            found.emplace_back(i, 1.0 - double(q));
                        }
                    }
                }
            }
        }
    }

    std::vector<vec3> position_;
    std::vector<vec3> normal_;
    std::vector<double> area_;
    std::vector<dvec3> light_;
    double total_ = 0.0;
    float longest_ = 0.0F;
    float size_ = 1.0F;
    Cells cells_;
};

// Landings close together as one: there may be many more of them than vertices.
std::vector<Deposit> gather_deposits(const RayScene& rays, const ParticleMap& particles,
                                     const std::vector<std::uint32_t>& landings, bool back, float cell, StopCheck& stop) {
    struct Sum {
        dvec3 position{0.0}, normal{0.0}, power{0.0};
        double weight = 0.0;
    };
    std::map<std::array<int, 4>, Sum> sums; // ordered: sums must not depend on a hash
    for (const std::uint32_t index : landings) {
        if (stop()) {
            return {};
        }
        const Landing& l = particles.landings()[index];
        const auto p = rays.triangle(l.surface, l.triangle);
        const vec3 at = p[0] + (p[1] - p[0]) * l.barycentric.x + (p[2] - p[0]) * l.barycentric.y;
        const vec3 n = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])) * (back ? -1.0F : 1.0F);
        const vec3 m = glm::abs(n);
        const int axis = m.x >= m.y && m.x >= m.z ? 0 : (m.y >= m.z ? 1 : 2);
        const ivec3 c = cell_of(at, cell);
        const Rgb power = particles.power(l);
        const double w = std::max(double(luminance(power)), 1e-30);
        Sum& s = sums[{c.x, c.y, c.z, 2 * axis + (n[axis] < 0.0F ? 1 : 0)}];
        s.position += dvec3(at) * w;
        s.normal += dvec3(n) * w;
        s.power += dvec3(power);
        s.weight += w;
    }
    std::vector<Deposit> out;
    out.reserve(sums.size());
    for (const auto& [key, s] : sums) {
        out.push_back({vec3(s.position / s.weight), vec3(glm::normalize(s.normal)), Rgb(s.power), 0.0F});
    }
    return out;
}

// Textures of one side and which of its landings are left to the mesh (`places`); returns its records.
std::vector<CausticRecord> build_side(const RayScene& rays, const SurfaceCharts& chart, const ParticleMap& particles,
                                      const std::vector<std::uint32_t>& landings, const CausticSettings& settings,
                                      CausticLight::Side& side, const RunContext& context) {
    const RaySurface& surface = rays.surfaces()[side.surface];
    std::vector<CausticLanding> charted;
    std::vector<std::uint32_t> place; // of charted ones among all
    CausticRecord uncharted;
    StopCheck stop(context, kLandingStride);
    for (std::uint32_t i = 0; i < landings.size() && !stop(); ++i) {
        const Landing& l = particles.landings()[landings[i]];
        const Rgb power = particles.power(l);
        if (chart.empty() || chart.chart_of_triangle[l.triangle] == SurfaceCharts::kNone) {
            side.places.push_back(i);
            ++uncharted.particles;
            uncharted.power_mesh += luminance(power);
            continue;
        }
        const auto p = rays.triangle(l.surface, l.triangle);
        const auto& uv = chart.uv[l.triangle];
        charted.push_back({l.triangle, l.barycentric, chart_uv(chart, l.triangle, l.barycentric), to_chart(p, uv, l.axis_a),
                           to_chart(p, uv, l.axis_b), power});
        place.push_back(i);
    }
    std::vector<CausticRecord> records;
    if (!charted.empty() && !context.should_stop()) {
        CausticSide built = build_caustics(charted, chart, *surface.positions, surface.triangles, settings, context);
        side.textures = std::move(built.textures);
        for (const std::uint32_t i : built.on_mesh) {
            side.places.push_back(place[i]);
        }
        records = std::move(built.records);
    }
    if (uncharted.particles > 0) {
        uncharted.chart = SurfaceCharts::kNone;
        uncharted.decision = uncharted.found = CausticRecord::Decision::Uncharted;
        uncharted.wish = settings.wish;
        uncharted.why = "pieces too small for a chart";
        records.push_back(uncharted);
    }
    for (CausticRecord& record : records) {
        record.node = surface.node;
        record.part = surface.part;
        record.back = side.back;
    }
    return records;
}

// What was lit by particles before and is not any more: `lit` has two marks a layer, front before back.
void put_out_others(std::vector<std::shared_ptr<const SurfaceLayer>>& layers, const std::vector<std::uint8_t>& lit) {
    for (std::size_t i = 0; i < layers.size(); ++i) {
        for (const bool back : {false, true}) {
            const SurfaceLayer& old = *layers[i];
            const bool any = !(back ? old.caustic_back : old.caustic_front).empty() ||
                             !(back ? old.caustic_textures_back : old.caustic_textures_front).empty();
            if (lit[2 * i + (back ? 1 : 0)] == 0 && any) {
                auto layer = std::make_shared<SurfaceLayer>(old);
                (back ? layer->caustic_back : layer->caustic_front).clear();
                (back ? layer->caustic_textures_back : layer->caustic_textures_front).clear();
                layers[i] = std::move(layer);
            }
        }
    }
}

} // namespace

std::vector<CausticWish> caustic_wishes(const Scene& scene, const RayScene& rays) {
    std::vector<CausticWish> out(rays.surfaces().size());
    for (std::size_t i = 0; i < out.size(); ++i) {
        const Node* node = scene.nodes.find(rays.surfaces()[i].node);
        out[i] = node != nullptr ? node->caustics : CausticWish{};
    }
    const bool any = std::any_of(out.begin(), out.end(), [](const CausticWish& wish) { return !wish.automatic(); });
    return any ? out : std::vector<CausticWish>();
}

std::size_t CausticLight::memory_bytes() const {
    std::size_t bytes = 0;
    for (const Side& side : sides) {
        for (const auto& t : side.textures) {
            bytes += t->memory_bytes();
        }
    }
    return bytes;
}

std::size_t CausticLight::texture_count() const {
    std::size_t count = 0;
    for (const Side& side : sides) {
        count += side.textures.size();
    }
    return count;
}

CausticLight build_caustic_light(const RayScene& rays, std::span<const SurfaceCharts> charts, const ParticleMap& particles,
                                 const CausticSettings& settings, const CausticReuse* reuse,
                                 std::span<const CausticWish> wishes, const RunContext& context) {
    CausticLight out;
    CausticSettings own = settings;
    std::vector<std::vector<std::uint32_t>> of_side(2 * rays.surfaces().size()); // by surface, front before back
    StopCheck stop(context, 16 * kLandingStride);
    for (std::uint32_t i = 0; i < particles.landings().size(); ++i) {
        const Landing& l = particles.landings()[i];
        of_side[2 * std::size_t(l.surface) + (l.back ? 1 : 0)].push_back(i);
        if (stop()) {
            return {};
        }
    }
    std::map<std::pair<std::uint32_t, bool>, const CausticLight::Side*> kept;
    for (std::size_t i = 0; reuse != nullptr && i < reuse->before.sides.size(); ++i) {
        const CausticLight::Side& side = reuse->before.sides[i];
        if (!std::binary_search(reuse->changed.begin(), reuse->changed.end(), side.surface)) {
            kept[{side.surface, side.back}] = &side;
        }
    }
    for (std::size_t number = 0; number < of_side.size(); ++number) {
        const std::vector<std::uint32_t>& landings = of_side[number];
        const std::pair key(std::uint32_t(number / 2), number % 2 != 0);
        if (landings.empty()) {
            continue;
        }
        if (context.should_stop()) {
            return {};
        }
        CausticLight::Side side;
        std::vector<CausticRecord> records;
        const auto old = kept.find(key);
        if (old != kept.end()) {
            side = *old->second;
            const auto from = reuse->before.records.begin() + std::ptrdiff_t(side.first_record);
            records.assign(from, from + std::ptrdiff_t(side.record_count));
        } else {
            side.surface = key.first;
            side.back = key.second;
            own.wish = wishes.empty() ? CausticWish{} : wishes[side.surface];
            records = build_side(rays, charts[side.surface], particles, landings, own, side, context);
        }
        side.on_mesh.resize(side.places.size());
        std::transform(side.places.begin(), side.places.end(), side.on_mesh.begin(),
                       [&](std::uint32_t place) { return landings[place]; });
        side.first_record = out.records.size();
        side.record_count = records.size();
        std::move(records.begin(), records.end(), std::back_inserter(out.records));
        out.sides.push_back(std::move(side));
    }
    return context.should_stop() ? CausticLight{} : out;
}

bool attach_caustics(std::vector<std::shared_ptr<const SurfaceLayer>>& layers, const RayScene& rays,
                     const ParticleMap& particles, const CausticLight& light, const RunContext& context) {
    std::map<std::pair<NodeId, std::uint32_t>, std::size_t> layer_of;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layer_of[{layers[i]->node, layers[i]->part}] = i;
    }
    std::vector<std::vector<Rgb>> vertices(light.sides.size());
    parallel_chunks(light.sides.size(), 1, [&](std::size_t begin, std::size_t, std::size_t) {
        const CausticLight::Side& side = light.sides[begin];
        const RaySurface& surface = rays.surfaces()[side.surface];
        const auto at = layer_of.find({surface.node, surface.part});
        if (side.on_mesh.empty() || at == layer_of.end()) {
            return;
        }
        if (context.should_stop()) {
            return;
        }
        VertexField field(*layers[at->second], surface, side.back);
        StopCheck stop(context, kLandingStride / 8);
        // A kernel with so many landings that their noise does not show, no finer than the mesh and within the surface.
        const auto n = float(side.on_mesh.size());
        const auto area = float(field.area());
        const float wanted = std::sqrt(kSmoothed * area / (kPi * n));
        const float reach =
            std::max(std::min(wanted, 0.5F * std::sqrt(area)), 1.2F * std::min(field.longest_edge(), wanted));
        field.sort_into_cells(reach);
        for (const Deposit& d : gather_deposits(rays, particles, side.on_mesh, side.back, reach / 3.0F, stop)) {
            field.add(d);
            if (stop()) {
                return;
            }
        }
        vertices[begin] = field.light();
    });
    if (context.should_stop()) {
        return false;
    }
    std::vector<std::uint8_t> lit(2 * layers.size(), 0);
    for (std::size_t i = 0; i < light.sides.size(); ++i) {
        const CausticLight::Side& side = light.sides[i];
        const RaySurface& surface = rays.surfaces()[side.surface];
        const auto at = layer_of.find({surface.node, surface.part});
        if (at == layer_of.end()) {
            continue;
        }
        lit[2 * at->second + (side.back ? 1 : 0)] = 1;
        auto layer = std::make_shared<SurfaceLayer>(*layers[at->second]);
        (side.back ? layer->caustic_back : layer->caustic_front) = std::move(vertices[i]);
        (side.back ? layer->caustic_textures_back : layer->caustic_textures_front) = side.textures;
        layers[at->second] = std::move(layer);
    }
    put_out_others(layers, lit);
    return true;
}

} // namespace atrium
