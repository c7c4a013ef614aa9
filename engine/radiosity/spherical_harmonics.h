// Real spherical harmonics of order 2: how a cluster of faces with many normals emits and receives (Ramamoorthi & Hanrahan
// 2001 show that nine numbers hold irradiance over all normals to about 1 % on average).
#pragma once

#include "engine/base/units.h"

#include <array>

namespace atrium {

inline constexpr std::size_t kShCount = 9;
using Sh = std::array<float, kShCount>;
using ShRgb = std::array<Rgb, kShCount>;

/// Basis functions at unit direction d.
inline Sh sh_basis(const vec3& d) {
    return {0.282094792F,
            0.488602512F * d.y,
            0.488602512F * d.z,
            0.488602512F * d.x,
            1.092548431F * d.x * d.y,
            1.092548431F * d.y * d.z,
            0.315391565F * (3.0F * d.z * d.z - 1.0F),
            1.092548431F * d.x * d.z,
            0.546274215F * (d.x * d.x - d.y * d.y)};
}

/// Zonal coefficients of the clamped cosine: pi, 2 pi / 3, pi / 4.
inline constexpr std::array<float, kShCount> kClampedCosine{3.14159265F,  2.09439510F,  2.09439510F,
                                                            2.09439510F,  0.785398163F, 0.785398163F,
                                                            0.785398163F, 0.785398163F, 0.785398163F};

/// Coefficients of w * max(0, dot(n, .)).
inline Sh sh_clamped_cosine(const vec3& n, float w) {
    Sh s = sh_basis(n);
    for (std::size_t i = 0; i < kShCount; ++i) {
        s[i] *= kClampedCosine[i] * w;
    }
    return s;
}

inline float sh_dot(const Sh& a, const Sh& b) {
    float sum = 0.0F;
    for (std::size_t i = 0; i < kShCount; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}
inline Rgb sh_dot(const ShRgb& a, const Sh& b) {
    Rgb sum(0.0F);
    for (std::size_t i = 0; i < kShCount; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

} // namespace atrium
