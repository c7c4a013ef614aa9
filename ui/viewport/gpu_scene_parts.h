// Small questions that the gpu_scene_*.cpp files share; for them and nobody else.
#pragma once

#include "ui/viewport/gpu_scene.h"

#include <algorithm>
#include <array>

namespace atrium::ui {

constexpr int kProbeLevels = 6; ///< of the reflection probe's cube map

/// True when a box lies wholly outside one side of the view's window (x and y from, x and y to; -1 to 1 is all).
inline bool out_of_sight(const Box3& box, const mat4& mvp, const vec4& window = vec4(-1.0F, -1.0F, 1.0F, 1.0F)) {
    std::array<int, 6> outside{};
    for (int i = 0; i < 8; ++i) {
        const vec4 p = mvp * vec4((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z, 1.0F);
        outside[0] += p.x < window.x * p.w;
        outside[1] += p.x > window.z * p.w;
        outside[2] += p.y < window.y * p.w;
        outside[3] += p.y > window.w * p.w;
        outside[4] += p.z < -p.w;
        outside[5] += p.z > p.w;
    }
    return std::find(outside.begin(), outside.end(), 8) != outside.end();
}

inline bool is_glass(const Material& m) {
    const MaterialKind kind = classify(m);
    return kind == MaterialKind::DielectricThin || kind == MaterialKind::DielectricSolid;
}
inline bool is_metal(const Material& m) {
    const MaterialKind kind = classify(m);
    return kind == MaterialKind::Mirror || kind == MaterialKind::Glossy;
}

/// A unit normal as GL_INT_2_10_10_10_REV; never 0.
inline std::uint32_t pack_normal(const vec3& n) {
    const auto ten_bits = [](float x) {
        return std::uint32_t(std::int32_t(std::lround(std::clamp(x, -1.0F, 1.0F) * 511.0F))) & 0x3FFU;
    };
    return ten_bits(n.x) | (ten_bits(n.y) << 10U) | (ten_bits(n.z) << 20U);
}

inline dmat4 relative_to_eye(const ViewItem& item, const dvec3& eye) {
    dmat4 m = item.world;
    m[3] -= dvec4(eye, 0.0);
    return m;
}

} // namespace atrium::ui
