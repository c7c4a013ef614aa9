// The one door to GLM: the rest of the program includes this header and never <glm/...> itself.
#pragma once

#include <glm/common.hpp>
#include <glm/ext/matrix_double4x4.hpp>
#include <glm/ext/matrix_float3x3.hpp>
#include <glm/ext/matrix_float4x4.hpp>
#include <glm/ext/quaternion_double.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int3.hpp>
#include <glm/ext/vector_uint3.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <limits>

namespace atrium {

using glm::dmat3;
using glm::dmat4;
using glm::dquat;
using glm::dvec2;
using glm::dvec3;
using glm::dvec4;
using glm::ivec3;
using glm::mat3;
using glm::mat4;
using glm::uvec3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

inline constexpr float kPi = 3.14159265358979323846F;
inline constexpr double kPiD = 3.14159265358979323846;
inline constexpr float kInvPi = 0.31830988618379067154F;

/// True when every component is a finite number (neither NaN nor infinite).
inline bool is_finite(const vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }
inline bool is_finite(const vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }
inline bool is_finite(const dvec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Largest of the three components.
inline float max_component(const vec3& v) { return std::fmax(v.x, std::fmax(v.y, v.z)); }

/// Axis-aligned box; empty (min > max) until a point is added.
template <class Vec> struct BoxT {
    Vec min{std::numeric_limits<typename Vec::value_type>::infinity()};
    Vec max{-std::numeric_limits<typename Vec::value_type>::infinity()};

    void add(const Vec& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    void add(const BoxT& b) {
        min = glm::min(min, b.min);
        max = glm::max(max, b.max);
    }
    [[nodiscard]] bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
    [[nodiscard]] Vec centre() const { return (min + max) * typename Vec::value_type(0.5); }
    [[nodiscard]] Vec size() const { return empty() ? Vec(0) : max - min; }
    [[nodiscard]] typename Vec::value_type diagonal() const { return empty() ? 0 : glm::length(max - min); }
};
using Box3 = BoxT<vec3>;
using DBox3 = BoxT<dvec3>;

/// Orthonormal tangent frame around unit vector n (Duff et al. 2017, branchless, no singular direction).
inline void make_frame(const vec3& n, vec3& t, vec3& b) {
    const float s = std::copysign(1.0F, n.z);
    const float a = -1.0F / (s + n.z);
    const float c = n.x * n.y * a;
    t = vec3(1.0F + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

} // namespace atrium
