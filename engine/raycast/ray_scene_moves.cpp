#include "engine/raycast/ray_scene_impl.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr double kAway = 20.0; // diagonals of the scene down to where things are that are not shown

} // namespace

// Walks the tree of `now` beside what was built. Nothing when more than placements differ.
std::optional<RayScene::Impl::Changes> RayScene::Impl::find_changes(const Scene& now, NewThings things) const {
    struct Entry {
        NodeId id;
        bool moved = false; // with an ancestor
    };
    std::vector<Entry> stack;
    for (auto id = now.roots.rbegin(); id != now.roots.rend(); ++id) {
        stack.push_back({*id});
    }
    Changes out;
    std::vector<std::uint8_t> stays(placed.size(), 0);
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
        if (now.shapes.find(node->shape) == nullptr) {
            continue;
        }
        const std::optional<std::size_t> index = find_placed(now, entry.id, next, entry.moved, things);
        if (!index) { // new, or no longer in its order, or another thing
            if (things == NewThings::Refuse) {
                return std::nullopt;
            }
            out.added.push_back(entry.id);
            continue;
        }
        stays[*index] = 1;
        next = *index < built ? *index + 1 : next;
        if (entry.moved || placed[*index].absent) {
            out.placed.push_back(*index);
        }
    }
    for (std::size_t i = 0; i < placed.size(); ++i) {
        if (stays[i] == 0 && !placed[i].absent) {
            out.gone.push_back(i);
        }
    }
    return out;
}

std::optional<std::size_t> RayScene::Impl::find_placed(const Scene& now, NodeId id, std::size_t next, bool moved,
                                                       NewThings things) const {
    while (next < built && placed[next].node != id) {
        ++next;
    }
    if (next < built && is_same(now, next, moved, things)) {
        return next;
    }
    for (std::size_t i = placed.size(); i-- > built;) { // the newest first
        if (placed[i].node == id && is_same(now, i, moved, things)) {
            return i;
        }
    }
    return std::nullopt;
}

bool RayScene::Impl::is_same(const Scene& now, std::size_t index, bool moved, NewThings things) const {
    const Placed& place = placed[index];
    const Node& node = *now.nodes.find(place.node);
    const Node* was = place.absent ? &*place.absent : scene.nodes.find(place.node);
    if (was == nullptr || was->shape != node.shape || was->materials != node.materials ||
        !(place.geometry == now.shapes.find(node.shape)->geometry)) {
        return false;
    }
    if (things == NewThings::Refuse) {
        return true;
    }
    // What is stretched has other charts and elements: it is another thing.
    constexpr double kStretch = 1e-5;
    if (moved || place.absent) {
        const dmat3 a(place.to_engine), b(now.world_matrix(place.node));
        const dmat3 before = glm::transpose(a) * a, after = glm::transpose(b) * b;
        for (int k = 0; k < 3; ++k) {
            const double slack = kStretch * (before[0][0] + before[1][1] + before[2][2]);
            if (!(max_component(vec3(glm::abs(after[k] - before[k]))) <= slack)) {
                return false;
            }
        }
        if ((glm::determinant(a) < 0.0) != (glm::determinant(b) < 0.0)) {
            return false;
        }
    }
    return materials_fit(now, index);
}

// Colours of what is shown were taken over by recolor(); what comes back must be what it was.
bool RayScene::Impl::materials_fit(const Scene& now, std::size_t index) const {
    const Placed& place = placed[index];
    for (std::uint32_t i = place.first_surface; i < place.first_surface + place.surfaces; ++i) {
        const Material* is = now.materials.find(surfaces[i].material);
        is = is != nullptr ? is : &default_material();
        if (is != materials[i] && !(*is == *materials[i])) {
            return false;
        }
    }
    return true;
}

// Materials and textures that both scenes have are the same.
bool RayScene::Impl::only_came_or_went(const Scene& now) const {
    bool same = true;
    scene.materials.for_each([&](MaterialId id, const Material& was) {
        const Material* is = now.materials.find(id);
        same = same && (is == nullptr || *is == was);
    });
    scene.textures.for_each([&](TextureId id, const Texture& was) {
        const Texture* is = now.textures.find(id);
        same = same && (is == nullptr || *is == was);
    });
    return same;
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
std::optional<double> RayScene::Impl::new_extent(const std::vector<Replaced>& replaced,
                                                 const std::vector<DBox3>& added) const {
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
    for (const DBox3& box : added) {
        all.add(box);
    }
    const double out = all.diagonal();
    const bool same = std::all_of(insides.begin(), insides.end(), [&](const Inside& inside) {
        return is_small(*worlds[inside.placed], out) == inside.small || !is_solid(*inside.mesh, {});
    });
    return same ? std::optional(out) : std::nullopt;
}

std::optional<std::vector<MovedSurface>> RayScene::Impl::move_to(const Scene& now, NewThings things) {
    const bool other_materials = scene.materials != now.materials || scene.textures != now.textures;
    if (other_materials && (things == NewThings::Refuse || !only_came_or_went(now))) {
        return std::nullopt;
    }
    const std::optional<Changes> changes = find_changes(now, things);
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
    std::vector<DBox3> added;
    for (const NodeId id : changes->added) {
        added.push_back(now.world_bounds(id));
    }
    const std::optional<double> extent_now = new_extent(replaced, added);
    if (!extent_now) {
        return std::nullopt;
    }
    take_over(now, *changes);
    std::vector<MovedSurface> out = take_over(std::move(replaced));
    if (other_materials) {
        take_materials(now);
    }
    extent = *extent_now;
    for (const NodeId id : changes->added) {
        append(id, out);
    }
    finish_move(out, *extent_now);
    return out;
}

// Materials of what is shown are those of `now`; absent things keep theirs.
void RayScene::Impl::take_materials(const Scene& now) {
    const auto kept = [&](std::size_t i) {
        return std::any_of(old_materials.begin(), old_materials.end(),
                           [&](const auto& old) { return old.get() == materials[i]; });
    };
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const bool lost = surfaces[i].material && now.materials.find(surfaces[i].material) == nullptr;
        if (lost && materials[i] != &default_material() && !kept(i)) {
            old_materials.push_back(std::make_unique<const Material>(*materials[i]));
            materials[i] = old_materials.back().get();
        }
    }
    scene.materials = now.materials;
    scene.textures = now.textures;
    for (std::size_t i = 0; i < surfaces.size(); ++i) {
        const Material* is = scene.materials.find(surfaces[i].material);
        if (is != nullptr && (!kept(i) || *is == *materials[i])) {
            materials[i] = is;
        }
    }
}

void RayScene::Impl::append(NodeId id, std::vector<MovedSurface>& out) {
    const Node& node = *scene.nodes.find(id);
    const Shape& shape = *scene.shapes.find(node.shape);
    Known known;
    const auto first = std::uint32_t(surfaces.size());
    add_node(id, node, shape, tessellate(shape.geometry, {curve_segments(node)}), known, {});
    if (twins) {
        embree.tell_fronts(); // of the scenes that are made from now on: those before have none
    }
    for (std::uint32_t i = first; i < surfaces.size(); ++i) {
        out.push_back({i, {}, surface_bounds[i], true, false, true});
    }
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

void RayScene::Impl::take_over(const Scene& now, const Changes& changes) {
    if (!changes.added.empty()) {
        scene.nodes = now.nodes;
        scene.shapes = now.shapes;
        return;
    }
    for (const NodeId id : changes.nodes) {
        Node* was = scene.nodes.find(id);
        if (was == nullptr) { // a group that came new
            scene.nodes = now.nodes;
            return;
        }
        *was = *now.nodes.find(id);
    }
}

std::vector<MovedSurface> RayScene::Impl::take_over(std::vector<Replaced> replaced) {
    std::vector<MovedSurface> out;
    for (Replaced& r : replaced) {
        Placed& place = placed[r.placed];
        place.world = r.world;
        place.to_engine = r.to_engine;
        const bool came_or_went = place.absent.has_value() != r.absent.has_value();
        place.absent = std::move(r.absent);
        for (std::size_t i = 0; i < r.surfaces.size(); ++i) {
            const std::size_t surface = place.first_surface + i;
            out.push_back({std::uint32_t(surface), surface_bounds[surface], r.bounds[i], came_or_went,
                           place.absent.has_value(), false});
            surface_bounds[surface] = r.bounds[i];
            surfaces[surface] = std::move(r.surfaces[i]);
        }
    }
    return out;
}

// All that follows from new placements.
void RayScene::Impl::finish_move(std::span<const MovedSurface> moved, double extent_now) {
    extent = extent_now;
    for (Inside& inside : insides) {
        inside.small = is_small(placed[inside.placed].world, extent);
    }
    if (moved.empty()) {
        return;
    }
    bounds = {};
    for (const Placed& place : placed) {
        for (std::uint32_t i = place.first_surface; !place.absent && i < place.first_surface + place.surfaces; ++i) {
            bounds.add(surface_bounds[i]);
        }
    }
    std::vector<std::uint32_t> numbers;
    for (const MovedSurface& m : moved) {
        numbers.push_back(m.surface);
        filters[m.surface] = filters_light(*materials[m.surface], surfaces[m.surface]) ? 1 : 0;
    }
    any_filter = std::find(filters.begin(), filters.end(), 1) != filters.end();
    embree.move(numbers, surfaces, filters, surface_bounds);
}

} // namespace atrium
