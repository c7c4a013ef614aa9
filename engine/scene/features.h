// What this scene needs from the engine, decided before anything is built; what it does not need is never allocated.
#pragma once

#include "engine/scene/scene.h"

#include <string>
#include <vector>

namespace atrium {

/// One line of the statistics' `features` object.
struct Feature {
    std::string name; ///< stable key of CONTRACTS
    bool used = false;
    std::string why; ///< one sentence: what in the scene asks for it, or why it is left out
};

/// Features in a fixed order: particles, caustic_textures, octree, refraction, glossy, sun, sky, textures, direct_layer,
/// specular_view, transmittance, alpha_cutouts, photometry.
std::vector<Feature> scene_features(const Scene& scene);
const Feature& find_feature(const std::vector<Feature>& features, const std::string& name);

} // namespace atrium
