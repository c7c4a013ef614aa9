#include "engine/solver/reflected_change.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kMostShare = 4.0F; // beyond it vertex and leaves have little to do with each other

// What is gathered at a vertex is more exact than leaves are. Light that goes is taken in proportion to what the vertex has
// of its leaves' light, so that nothing is left of what went out; light that comes is half as even as that, since paint
// brings it from all sides and a lamp from where it came before. Where leaves were all but dark proportions say nothing.
// `dark`: lux.
Rgb followed(const Rgb& vertex, const Rgb& before, const Rgb& now, float dark) {
    const Rgb known = before / (before + Rgb(std::max(dark, 1e-30F)));
    const Rgb share = Rgb(1.0F) + known * (vertex / glm::max(before, Rgb(1e-30F)) - Rgb(1.0F));
    const Rgb less = glm::min(now - before, Rgb(0.0F)), more = glm::max(now - before, Rgb(0.0F));
    return glm::max(vertex + less * share + more * (0.5F * (Rgb(1.0F) + glm::min(share, Rgb(kMostShare)))), Rgb(0.0F));
}

// Irradiance of a leaf but for what `part` (may be empty) has of it.
Rgb without(const Rgb& all, const std::vector<Rgb>& part, std::uint32_t leaf) {
    return leaf < part.size() ? glm::max(all - part[leaf], Rgb(0.0F)) : all;
}

} // namespace

ReflectedChange::ReflectedChange(const Hierarchy& h, const RayScene& rays, const LayerSet& layers) {
    constexpr float kTraceOfMean = 0.002F; // of the mean irradiance
    trace_ = h.empty() ? 0.0F : kTraceOfMean * luminance(h.elements.front().irradiance);
    append(h, rays, layers, 0);
}

void ReflectedChange::append(const Hierarchy& h, const RayScene& rays, const LayerSet& layers, std::size_t first_layer) {
    before_.reserve(h.elements.size());
    for (std::size_t i = before_.size(); i < h.elements.size(); ++i) {
        before_.push_back(h.elements[i].irradiance);
    }
    surfaces_.resize(layers.surfaces.size());
    take_layers(h, rays, layers, first_layer, surfaces_.size());
}

void ReflectedChange::take_layers(const Hierarchy& h, const RayScene& rays, const LayerSet& layers, std::size_t first,
                                  std::size_t last) {
    for (std::size_t i = first; i < last; ++i) {
        take_layer(h, rays, layers, i);
    }
}

void ReflectedChange::take_layer(const Hierarchy& h, const RayScene& rays, const LayerSet& layers, std::size_t i) {
    constexpr float kClear = 1e-3F; // metres: rays down to the leaf start this far above the surface
    const SurfaceLayer& layer = *layers.surfaces[i];
    const std::uint32_t surface = layers.places[i].surface;
    const dmat4& to_engine = rays.surfaces()[surface].to_engine;
    const DisplayMesh& mesh = *layer.mesh;
    const std::size_t triangles = mesh.indices.size() / 3;
    const auto find = [&](Side& side, bool back) {
        side.leaf.assign(triangles, Element::kNone);
        parallel_chunks(triangles, 256, [&](std::size_t begin, std::size_t end, std::size_t) {
            for (std::size_t t = begin; t < end; ++t) {
                vec3 p[3];
                for (std::size_t k = 0; k < 3; ++k) {
                    const dvec3 local(mesh.positions[mesh.indices[3 * t + k]]);
                    p[k] = vec3(dvec3(to_engine * dvec4(local, 1.0)));
                }
                vec3 n = glm::cross(p[1] - p[0], p[2] - p[0]);
                const float length = glm::length(n);
                if (!(length > 0.0F)) {
                    continue;
                }
                n *= (back != rays.surfaces()[surface].mirrored ? -1.0F : 1.0F) / length;
                const vec3 middle = (p[0] + p[1] + p[2]) / 3.0F;
                const Hit hit = rays.nearest({middle + n * kClear, -n, 2.0F * kClear});
                if (hit && hit.surface == surface && hit.front != back) {
                    side.leaf[t] = h.leaf_at(hit.surface, hit.triangle, back, hit.barycentric);
                }
            }
        });
    };
    surfaces_[i].front.base = layer.irradiance_front;
    find(surfaces_[i].front, false);
    surfaces_[i].back = {};
    if (layer.has_back()) {
        surfaces_[i].back.base = layer.irradiance_back;
        find(surfaces_[i].back, true);
    }
}

// Mean change of the triangles around each vertex, by area; nothing where all of it is only a trace.
std::vector<ReflectedChange::OfVertex> ReflectedChange::of_vertices(const Hierarchy& h, const OfLeaves& leaves,
                                                                    const DisplayMesh& mesh, std::size_t layer,
                                                                    bool back) const {
    const Side& side = back ? surfaces_[layer].back : surfaces_[layer].front;
    std::vector<OfVertex> out(side.base.size());
    const auto irradiance_of = [&](std::uint32_t leaf) {
        return without(h.elements[leaf].irradiance, leaves.elsewhere.now, leaf);
    };
    const auto irradiance_before = [&](std::uint32_t leaf) { return without(before_[leaf], leaves.elsewhere.first, leaf); };
    const bool any = std::any_of(side.leaf.begin(), side.leaf.end(), [&](std::uint32_t leaf) {
        return leaf != Element::kNone && luminance(glm::abs(irradiance_of(leaf) - irradiance_before(leaf))) > trace_;
    });
    if (!any) {
        return out;
    }
    for (std::size_t t = 0; t < side.leaf.size(); ++t) {
        const std::uint32_t leaf = side.leaf[t];
        if (leaf == Element::kNone) {
            continue;
        }
        const Rgb sight = leaves.beside.empty() ? Rgb(0.0F) : leaves.beside[leaf];
        const std::uint32_t* v = &mesh.indices[3 * t];
        const float own = glm::length(
            glm::cross(mesh.positions[v[1]] - mesh.positions[v[0]], mesh.positions[v[2]] - mesh.positions[v[0]]));
        for (int k = 0; k < 3; ++k) {
            out[v[k]].before += irradiance_before(leaf) * own;
            out[v[k]].now += irradiance_of(leaf) * own;
            out[v[k]].sight += sight * own;
            out[v[k]].area += own;
        }
    }
    for (OfVertex& v : out) {
        if (v.area > 0.0F) {
            v.before /= v.area;
            v.now /= v.area;
            v.sight /= v.area;
        }
    }
    return out;
}

// The leaves' word, but for what a vertex knows itself.
void ReflectedChange::changed(const Hierarchy& h, const OfLeaves& leaves, const DisplayMesh& mesh, std::size_t layer,
                              const std::vector<VertexChange>& known, bool back, std::vector<Rgb>& out) const {
    const Side& side = back ? surfaces_[layer].back : surfaces_[layer].front;
    out = side.base;
    const std::vector<OfVertex> said = of_vertices(h, leaves, mesh, layer, back);
    std::vector<std::uint8_t> covered(out.size(), 0);
    bool any_covered = false;
    auto next = known.begin();
    for (std::uint32_t v = 0; v < out.size(); ++v) {
        while (next != known.end() && (next->vertex < v || (next->vertex == v && next->back != back))) {
            ++next;
        }
        const bool knows = next != known.end() && next->vertex == v;
        if (knows && next->kind != VertexChange::Kind::Sight) {
            out[v] = next->light;
            if (next->kind == VertexChange::Kind::Covered) {
                covered[v] = 1;
                any_covered = true;
            }
            continue;
        }
        if (said[v].area > 0.0F) {
            out[v] = followed(out[v], said[v].before, glm::max(said[v].now - said[v].sight, Rgb(0.0F)), trace_);
        }
        out[v] = glm::max(out[v] + (knows ? next->light : said[v].sight), Rgb(0.0F));
    }
    // From the rim inwards.
    for (; any_covered;) {
        any_covered = false;
        std::vector<OfVertex> around(out.size());
        for (std::size_t t = 0; t < side.leaf.size(); ++t) {
            const std::uint32_t* v = &mesh.indices[3 * t];
            for (int k = 0; k < 3; ++k) {
                for (int j = 0; j < 3; ++j) {
                    if (covered[v[k]] != 0 && covered[v[j]] == 0) {
                        around[v[k]].now += out[v[j]];
                        around[v[k]].area += 1.0F;
                    }
                }
            }
        }
        for (std::uint32_t v = 0; v < out.size(); ++v) {
            if (around[v].area > 0.0F) {
                out[v] = around[v].now / around[v].area;
                covered[v] = 0;
                any_covered = true;
            }
        }
    }
}

std::size_t ReflectedChange::add_to(const Hierarchy& h, const std::vector<Rgb>& beside,
                                    const std::vector<std::vector<VertexChange>>& known,
                                    std::vector<std::shared_ptr<const SurfaceLayer>>& layers,
                                    const MattLight& elsewhere) const {
    const OfLeaves leaves{beside, elsewhere};
    static const std::vector<VertexChange> kNothing;
    std::vector<std::uint8_t> new_ones(layers.size(), 0);
    parallel_chunks(layers.size(), 1, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            const SurfaceLayer& old = *layers[i];
            const std::vector<VertexChange>& of_layer = known.empty() ? kNothing : known[i];
            std::vector<Rgb> front, back;
            changed(h, leaves, *old.mesh, i, of_layer, false, front);
            if (old.has_back()) {
                changed(h, leaves, *old.mesh, i, of_layer, true, back);
            }
            if (front != old.irradiance_front || back != old.irradiance_back) {
                auto layer = std::make_shared<SurfaceLayer>(old);
                layer->irradiance_front = std::move(front);
                layer->irradiance_back = std::move(back);
                layers[i] = std::move(layer);
                new_ones[i] = 1;
            }
        }
    });
    return std::size_t(std::count(new_ones.begin(), new_ones.end(), 1));
}

std::size_t ReflectedChange::memory_bytes() const {
    std::size_t bytes = before_.size() * sizeof(Rgb);
    for (const Surface& s : surfaces_) {
        for (const Side* side : {&s.front, &s.back}) {
            bytes += side->leaf.size() * sizeof(std::uint32_t) + side->base.size() * sizeof(Rgb);
        }
    }
    return bytes;
}

} // namespace atrium
