#include "engine/raycast/ray_scene_impl.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr double kAway = 20.0; // diagonals of the scene down to where things are that are not shown

} // namespace

// Walks the tree of `now` beside what was built. Nothing when more than placements differ.
std::optional<RayScene::Impl::Changes> RayScene::Impl::find_changes(const Scene& now) const {
    struct Entry {
        NodeId id;
        bool moved = false; // with an ancestor
    };
    std::vector<Entry> stack;
    for (auto id = now.roots.rbegin(); id != now.roots.rend(); ++id) {
        stack.push_back({*id});
    }
    Changes out;
    std::size_t next = 0;
    while (!stack.empty()) {
        Entry entry = stack.back();
        stack.pop_back();
        const Node* node = now.nodes.find(entry.id);
        if (node == nullptr || !node->visible) {
            continue;
        }
        const Node* was = scene.nodes.find(entry.id);
        if (was == nullptr || was->parent != node->parent || was->visible != node->visible ||
            was->transform != node->transform) {
            entry.moved = true;
            out.nodes.push_back(entry.id);
        }
        for (auto id = node->children.rbegin(); id != node->children.rend(); ++id) {
            stack.push_back({*id, entry.moved});
        }
        const Shape* shape = now.shapes.find(node->shape);
        if (shape == nullptr) {
            continue;
        }
        for (; next < placed.size() && placed[next].node != entry.id; ++next) {
            pass_over(next, out);
        }
        if (next == placed.size()) {
            return std::nullopt; // new, or no longer in its order
        }
        was = placed[next].absent ? &*placed[next].absent : was;
        if (was->shape != node->shape || was->materials != node->materials ||
            scene.shapes.find(was->shape)->geometry != shape->geometry) {
            return std::nullopt;
        }
        if (entry.moved || placed[next].absent) {
            out.placed.push_back(next);
        }
        ++next;
    }
    for (; next < placed.size(); ++next) {
        pass_over(next, out);
    }
    return out;
}

void RayScene::Impl::pass_over(std::size_t index, Changes& out) const {
    if (!placed[index].absent) {
        out.gone.push_back(index);
    }
}

// What is not shown any more is put where it does not matter, far below all else: so all that follows what moves follows
// this too, and when it comes back nothing has to be built.
RayScene::Impl::Replaced RayScene::Impl::put_away(std::size_t index) const {
    const Placed& place = placed[index];
    const dvec3 off(0.0, -kAway * double(bounds.diagonal()), 0.0);
    Replaced out{index, place.world, glm::translate(dmat4(1.0), off) * place.to_engine,
                 {},    {},          *scene.nodes.find(place.node)};
    auto positions = std::make_shared<std::vector<vec3>>();
    for (std::uint32_t i = place.first_surface; i < place.first_surface + place.surfaces; ++i) {
        if (positions->empty()) {
            for (const vec3& p : *surfaces[i].positions) {
                positions->push_back(p + vec3(off));
            }
        }
        RaySurface surface = surfaces[i];
        surface.positions = positions;
        surface.to_engine = out.to_engine;
        out.surfaces.push_back(std::move(surface));
        out.bounds.push_back({surface_bounds[i].min + vec3(off), surface_bounds[i].max + vec3(off)});
    }
    return out;
}

// A node at its new place; nothing when its triangles are not the ones it had.
std::optional<RayScene::Impl::Replaced> RayScene::Impl::replace_node(const Scene& now, std::size_t index) const {
    const Placed& place = placed[index];
    Replaced out{index, now.world_bounds(place.node), now.world_matrix(place.node), {}, {}, {}};
    out.to_engine[3] -= dvec4(origin, 0.0);
    if (out.to_engine == place.to_engine) {
        return out; // none of its surfaces moves
    }
    const auto positions = positions_of(*place.mesh, out.to_engine);
    std::uint32_t next = place.first_surface;
    const std::uint32_t end = place.first_surface + place.surfaces;
    for (std::size_t part = 0; part < place.mesh->parts.size(); ++part) {
        RaySurface surface;
        const bool has_surface = next < end && surfaces[next].part == part;
        if (has_surface) {
            surface = surfaces[next];
        } else {
            surface.mesh = place.mesh;
            surface.part = std::uint32_t(part);
        }
        surface.positions = positions;
        Box3 box;
        place_surface(surface, out.to_engine, box);
        if (surface.triangles.empty() == has_surface) {
            return std::nullopt;
        }
        if (!has_surface) {
            continue;
        }
        if (surface.mirrored != surfaces[next].mirrored || surface.triangles != surfaces[next].triangles) {
            return std::nullopt;
        }
        find_glass(surface, *materials[next]);
        out.surfaces.push_back(std::move(surface));
        out.bounds.push_back(box);
        ++next;
    }
    return out;
}

// Scene::bounds() of the new placements, and with it `extent`. Nothing when it makes any back reflect or stop to do so.
std::optional<double> RayScene::Impl::new_extent(const std::vector<Replaced>& replaced) const {
    std::vector<const DBox3*> worlds;
    std::vector<bool> absent;
    for (const Placed& p : placed) {
        worlds.push_back(&p.world);
        absent.push_back(p.absent.has_value());
    }
    for (const Replaced& r : replaced) {
        worlds[r.placed] = &r.world;
        absent[r.placed] = r.absent.has_value();
    }
    DBox3 all;
    for (std::size_t i = 0; i < worlds.size(); ++i) {
        if (!absent[i]) {
            all.add(*worlds[i]);
        }
    }
    const double out = all.diagonal();
    const bool same = std::all_of(insides.begin(), insides.end(), [&](const Inside& inside) {
        return is_small(*worlds[inside.placed], out) == inside.small || !is_solid(*inside.mesh, {});
    });
    return same ? std::optional(out) : std::nullopt;
}

std::optional<std::vector<MovedSurface>> RayScene::Impl::move_to(const Scene& now) {
    if (scene.materials != now.materials || scene.textures != now.textures) {
        return std::nullopt;
    }
    const std::optional<Changes> changes = find_changes(now);
    if (!changes) {
        return std::nullopt;
    }
    std::vector<Replaced> replaced;
    for (const std::size_t index : changes->placed) {
        std::optional<Replaced> one = replace_node(now, index);
        if (!one) {
            return std::nullopt;
        }
        replaced.push_back(std::move(*one));
    }
    for (const std::size_t index : changes->gone) {
        replaced.push_back(put_away(index));
    }
    const std::optional<double> extent_now = new_extent(replaced);
    if (!extent_now) {
        return std::nullopt;
    }
    take_over(now, changes->nodes);
    return take_over(std::move(replaced), *extent_now);
}

Result<std::vector<MaterialId>> RayScene::Impl::recolor(const Scene& now) {
    std::vector<MaterialId> changed, touched;
    std::string refusal;
    scene.materials.for_each([&](MaterialId id, const Material& was) {
        const Material* is = now.materials.find(id);
        if (is == nullptr || *is == was || !refusal.empty()) {
            return; // what is gone is move_to()'s to find
        }
        touched.push_back(id);
        const bool painted = is->base_color != was.base_color;
        if (painted && (is_specular(was) || lets_light_through(was))) {
            refusal = "the colour of a mirror, a metal or glass changed";
        }
        Material back = *is; // all but colours, and what light does not depend on
        back.base_color = was.base_color;
        back.emissive_color = was.emissive_color;
        back.emissive_strength = was.emissive_strength;
        back.name = was.name;
        back.extras = was.extras;
        back.other_extensions = was.other_extensions;
        back.other_textures = was.other_textures;
        if (!(back == was)) {
            refusal = "a material changed in more than its colour";
        }
        if (painted || is->emitted_radiance() != was.emitted_radiance()) {
            changed.push_back(id);
        }
    });
    if (!refusal.empty()) {
        return fail("", "", refusal, "A whole new solution answers");
    }
    for (const MaterialId id : touched) {
        *scene.materials.find(id) = *now.materials.find(id); // in place: `materials` points there
    }
    return changed;
}

void RayScene::Impl::take_over(const Scene& now, const std::vector<NodeId>& nodes) {
    for (const NodeId id : nodes) {
        Node* was = scene.nodes.find(id);
        if (was == nullptr) { // a group that came new
            scene.nodes = now.nodes;
            return;
        }
        *was = *now.nodes.find(id);
    }
}

std::vector<MovedSurface> RayScene::Impl::take_over(std::vector<Replaced> replaced, double extent_now) {
    std::vector<MovedSurface> out;
    for (Replaced& r : replaced) {
        Placed& place = placed[r.placed];
        place.world = r.world;
        place.to_engine = r.to_engine;
        const bool came_or_went = place.absent.has_value() != r.absent.has_value();
        place.absent = std::move(r.absent);
        for (std::size_t i = 0; i < r.surfaces.size(); ++i) {
            const std::size_t surface = place.first_surface + i;
            out.push_back(
                {std::uint32_t(surface), surface_bounds[surface], r.bounds[i], came_or_went, place.absent.has_value()});
            surface_bounds[surface] = r.bounds[i];
            surfaces[surface] = std::move(r.surfaces[i]);
        }
    }
    extent = extent_now;
    for (Inside& inside : insides) {
        inside.small = is_small(placed[inside.placed].world, extent);
    }
    if (out.empty()) {
        return out;
    }
    bounds = {};
    for (const Placed& place : placed) {
        for (std::uint32_t i = place.first_surface; !place.absent && i < place.first_surface + place.surfaces; ++i) {
            bounds.add(surface_bounds[i]);
        }
    }
    std::vector<std::uint32_t> moved;
    for (const MovedSurface& m : out) {
        moved.push_back(m.surface);
        filters[m.surface] = filters_light(*materials[m.surface], surfaces[m.surface]) ? 1 : 0;
    }
    any_filter = std::find(filters.begin(), filters.end(), 1) != filters.end();
    embree.move(moved, surfaces, filters, surface_bounds);
    return out;
}

} // namespace atrium
