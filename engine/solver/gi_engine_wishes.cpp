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

void GiEngine::keep_question(Impl& s, const Scene& scene, const SolveOptions& options) {
    s.live->scene = light_part(scene);
    s.live->options = options;
}

std::shared_ptr<const Solution> GiEngine::follow_wishes(const Scene& scene, const SolveOptions& options) {
    Impl& s = *impl_;
    if (!options.keep_for_updates || !s.live || !s.live->settled || !s.particles) {
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
    if (changed.empty() || !(light_part(scene) == live.scene)) {
        return nullptr;
    }
    s.wishes = std::move(wishes);
    const CausticReuse reuse{s.caustics, changed};
    s.caustics = build_caustic_light(*s.rays, s.charts, *s.particles, s.caustic_settings, &reuse, s.wishes);
    attach_caustics(live.layers.surfaces, *s.rays, *s.particles, s.caustics);
    auto solution = std::make_shared<Solution>(*live.shown);
    solution->revision = options.revision;
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
    return solution;
}

} // namespace atrium
