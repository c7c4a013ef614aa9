// Caustics shown otherwise: what a change of CausticWish alone asks for. No light goes another way by it, so that what the
// last complete solution kept is enough, and the result is what a whole new solution would be.
#include "engine/solver/gi_engine_impl.h"

#include <algorithm>

namespace atrium {
namespace {

// What light depends on, wishes about caustics aside.
Scene light_part(Scene scene) {
    scene.name.clear();
    scene.extras.clear();
    scene.asset_extras.clear();
    scene.cameras = {};
    for (const NodeId id : scene.nodes.keys()) {
        Node& node = *scene.nodes.find(id);
        node.name.clear();
        node.extras.clear();
        node.camera = {};
        node.locked = false;
        node.caustics = {};
    }
    return scene;
}

CausticWish wish_at(std::span<const CausticWish> wishes, std::size_t surface) {
    return wishes.empty() ? CausticWish{} : wishes[surface];
}

} // namespace

std::vector<std::uint32_t> surfaces_with_new_wishes(std::span<const CausticWish> before, std::span<const CausticWish> now) {
    std::vector<std::uint32_t> out;
    for (std::size_t i = 0; i < std::max(before.size(), now.size()); ++i) {
        if (wish_at(before, i) != wish_at(now, i)) {
            out.push_back(std::uint32_t(i));
        }
    }
    return out;
}

std::shared_ptr<const std::vector<SurfaceLandings>> landing_places(const RayScene& rays, const ParticleMap* particles) {
    auto out = std::make_shared<std::vector<SurfaceLandings>>();
    if (particles == nullptr) {
        return out;
    }
    constexpr std::size_t kNone = SIZE_MAX;
    std::vector<std::size_t> side(2 * rays.surfaces().size(), kNone);
    for (const Landing& l : particles->landings()) {
        const RaySurface& surface = rays.surfaces()[l.surface];
        std::size_t& at = side[2 * std::size_t(l.surface) + (l.back ? 1 : 0)];
        if (at == kNone) {
            at = out->size();
            out->push_back({surface.node, surface.part, l.back, {}});
        }
        const uvec3& t = surface.triangles[l.triangle];
        const std::vector<vec3>& p = surface.mesh->positions;
        (*out)[at].places.push_back(p[t.x] + (p[t.y] - p[t.x]) * l.barycentric.x + (p[t.z] - p[t.x]) * l.barycentric.y);
    }
    return out;
}

void GiEngine::keep_question(Impl& s, const Scene& scene, const SolveOptions& options) {
    s.live->scene = light_part(scene);
    s.live->options = options;
}

std::shared_ptr<const Solution> GiEngine::follow_wishes(const Scene& scene, const SolveOptions& options,
                                                        const RunContext& context) {
    Impl& s = *impl_;
    if (!options.keep_for_updates || !s.live || !s.live->untouched) {
        return nullptr;
    }
    Impl::Live& live = *s.live;
    const SolveOptions& then = live.options;
    if (then.quality != options.quality || then.seed != options.seed || then.target_error != options.target_error ||
        then.paper_mode != options.paper_mode || then.particles != options.particles) {
        return nullptr;
    }
    std::vector<CausticWish> wishes = caustic_wishes(scene, *s.rays);
    const std::vector<std::uint32_t> changed = surfaces_with_new_wishes(s.wishes, wishes);
    const bool asked_for_landings = options.keep_landings && !live.shown->landings;
    const bool asked_for_insides = options.keep_insides && live.insides.expired();
    if ((changed.empty() && !asked_for_landings && !asked_for_insides) || !(light_part(scene) == live.scene)) {
        return nullptr;
    }
    if (!changed.empty() && s.particles) { // without particles a wish changes nothing
        const CausticReuse reuse{s.caustics, changed};
        CausticLight light =
            build_caustic_light(*s.rays, s.charts, *s.particles, s.caustic_settings, &reuse, wishes, context);
        if (!attach_caustics(live.layers.surfaces, *s.rays, *s.particles, light, context)) {
            return nullptr; // stopped: nothing has changed
        }
        s.caustics = std::move(light);
    }
    s.wishes = std::move(wishes);
    auto solution = std::make_shared<Solution>(*live.shown);
    solution->revision = options.revision;
    if (!options.keep_landings) {
        solution->landings.reset();
    } else if (asked_for_landings) {
        solution->landings = landing_places(*s.rays, s.particles.get());
    }
    solution->surfaces = live.layers.surfaces;
    solution->caustic_records = s.caustics.records;
    solution->statistics.memory.caustic_textures = s.caustics.memory_bytes();
    const std::vector<Feature> wanted = scene_features(scene);
    for (Feature& feature : solution->statistics.features) {
        if (feature.name == "caustic_textures") {
            feature = find_feature(wanted, feature.name);
        }
    }
    s.tell_left_out(solution->statistics.features);
    live.shown = solution;
    if (!options.keep_insides) {
        return solution;
    }
    auto with_insides = std::make_shared<Solution>(*solution);
    with_insides->insides = asked_for_insides ? s.tell_insides() : live.insides.lock();
    return with_insides;
}

} // namespace atrium
