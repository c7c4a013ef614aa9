#include "engine/geometry/repeated_triangles.h"

#include "engine/base/rng.h"

#include <array>
#include <bit>

namespace atrium {
namespace {

/// Corners in ascending order, and which way round they were.
struct Place {
    std::array<vec3, 3> corner;
    bool turned = false;
};

bool less(const vec3& a, const vec3& b) { return a.x != b.x ? a.x < b.x : (a.y != b.y ? a.y < b.y : a.z < b.z); }

Place place_of(const MeshData& mesh, std::uint32_t first_index) {
    Place out;
    for (std::size_t k = 0; k < 3; ++k) {
        out.corner[k] = mesh.positions[mesh.indices[std::size_t(first_index) + k]] + vec3(0.0F); // -0 becomes +0
    }
    const auto order = [&](std::size_t a, std::size_t b) {
        if (less(out.corner[b], out.corner[a])) {
            std::swap(out.corner[a], out.corner[b]);
            out.turned = !out.turned;
        }
    };
    order(0, 1);
    order(1, 2);
    order(0, 1);
    return out;
}

std::uint64_t hash_of(const Place& place) {
    std::uint64_t hash = 0;
    for (const vec3& p : place.corner) {
        const auto x = std::uint64_t(std::bit_cast<std::uint32_t>(p.x)),
                   y = std::uint64_t(std::bit_cast<std::uint32_t>(p.y));
        hash = hash_combine(hash_combine(hash, x | y << 32U), std::bit_cast<std::uint32_t>(p.z));
    }
    return hash;
}

} // namespace

RepeatedTriangles repeated_triangles(const MeshData& mesh, const RunContext& context) {
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    struct Slot {
        std::uint32_t first = kNone;                     // index of the first triangle there
        std::array<std::uint32_t, 2> part{kNone, kNone}; // the first that has one there, by Place::turned
    };
    RepeatedTriangles out;
    StopCheck stop(context, kMeshStride);
    std::vector<Slot> slots(std::bit_ceil(2 * (mesh.indices.size() / 3) + 1));
    for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) {
        RepeatedTriangles::Part& repeated = out.parts.emplace_back();
        const MeshPart& part = mesh.parts[p];
        for (std::uint32_t t = 0; t < part.index_count / 3 && !stop(); ++t) {
            const std::uint32_t index = part.first_index + 3 * t;
            const Place place = place_of(mesh, index);
            std::size_t at = std::size_t(hash_of(place)) & (slots.size() - 1);
            while (slots[at].first != kNone && place_of(mesh, slots[at].first).corner != place.corner) {
                at = (at + 1) & (slots.size() - 1);
            }
            Slot& slot = slots[at];
            slot.first = slot.first == kNone ? index : slot.first;
            std::uint32_t& like = slot.part[place.turned ? 1 : 0];
            const std::uint32_t against = slot.part[place.turned ? 0 : 1];
            out.twins = out.twins || against != kNone;
            if (like == p) {
                repeated.same.push_back(t);
            } else if (against == p && like == kNone) {
                repeated.turned.push_back(t);
            }
            like = like == kNone ? p : like;
        }
    }
    return out;
}

} // namespace atrium
