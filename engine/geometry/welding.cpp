#include "engine/geometry/welding.h"

#include <algorithm>
#include <bit>

namespace atrium {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

/// Open addressing over the cells of a grid much coarser than the tolerance: few points are near the wall of a cell.
class PointTable {
public:
    PointTable(float tolerance, std::size_t most) : tolerance_(tolerance), per_cell_(1.0F / (64.0F * tolerance)) {
        slots_.assign(std::bit_ceil(std::max<std::size_t>(2 * most, 16)), kNone);
    }

    std::uint32_t insert(const vec3& p, std::vector<vec3>& points) {
        const vec3 low = glm::floor((p - tolerance_) * per_cell_);
        const vec3 high = glm::floor((p + tolerance_) * per_cell_);
        const vec3 own = glm::floor(p * per_cell_);
        const std::uint32_t found = find(own, p, points);
        if (found != kNone) {
            return found;
        }
        if (low != high) {
            for (unsigned corner = 0; corner < 8; ++corner) {
                const vec3 cell((corner & 1U) != 0 ? high.x : low.x, (corner & 2U) != 0 ? high.y : low.y,
                                (corner & 4U) != 0 ? high.z : low.z);
                const std::uint32_t near = cell == own ? kNone : find(cell, p, points);
                if (near != kNone) {
                    return near;
                }
            }
        }
        std::size_t slot = start(own);
        while (slots_[slot] != kNone) {
            slot = (slot + 1) & (slots_.size() - 1);
        }
        slots_[slot] = std::uint32_t(points.size());
        points.push_back(p);
        return slots_[slot];
    }

private:
    [[nodiscard]] std::size_t start(const vec3& cell) const {
        const auto bits = [](float x) { return std::uint64_t(std::bit_cast<std::uint32_t>(x + 0.0F)); };
        std::uint64_t h = bits(cell.x) * 0x9E3779B97F4A7C15ULL;
        h = (h ^ (h >> 32) ^ bits(cell.y)) * 0xBF58476D1CE4E5B9ULL;
        h = (h ^ (h >> 32) ^ bits(cell.z)) * 0x94D049BB133111EBULL;
        return (h ^ (h >> 31)) & (slots_.size() - 1);
    }
    [[nodiscard]] std::uint32_t find(const vec3& cell, const vec3& p, const std::vector<vec3>& points) const {
        for (std::size_t slot = start(cell); slots_[slot] != kNone; slot = (slot + 1) & (slots_.size() - 1)) {
            const vec3 d = glm::abs(points[slots_[slot]] - p);
            if (max_component(d) <= tolerance_) {
                return slots_[slot];
            }
        }
        return kNone;
    }

    float tolerance_;
    float per_cell_;
    std::vector<std::uint32_t> slots_;
};

} // namespace

WeldedTriangles weld(std::span<const vec3> positions, std::span<const uvec3> triangles, float tolerance,
                     const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    WeldedTriangles out;
    out.triangles.resize(triangles.size());
    // A part of a large mesh uses few of its positions: they are then not even looked at.
    const bool known = positions.size() <= 4 * triangles.size();
    std::vector<std::uint32_t> welded(known ? positions.size() : 0, kNone);
    const std::size_t most = std::min(known ? positions.size() : 3 * triangles.size(), 3 * triangles.size());
    PointTable table(std::max(tolerance, std::numeric_limits<float>::min() * 1e6F), most);
    out.points.reserve(most);
    for (std::size_t t = 0; t < triangles.size() && !stop(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t i = triangles[t][k];
            std::uint32_t point = known ? welded[i] : kNone;
            if (point == kNone) {
                point = table.insert(positions[i], out.points);
                if (known) {
                    welded[i] = point;
                }
            }
            out.triangles[t][k] = point;
        }
    }
    return out;
}

std::vector<std::uint32_t> edge_rings(const WeldedTriangles& mesh, const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    const std::size_t count = 3 * mesh.triangles.size();
    // Half-edges sorted by lower end (counting), then by upper end within the few that share it.
    std::vector<std::uint32_t> first(mesh.points.size() + 1, 0);
    const auto ends = [&](std::size_t h) {
        const uvec3& t = mesh.triangles[h / 3];
        const std::uint32_t a = t[int(h % 3)];
        const std::uint32_t b = t[int((h % 3 + 1) % 3)];
        return std::pair(std::min(a, b), std::max(a, b));
    };
    for (std::size_t h = 0; h < count && !stop(); ++h) {
        ++first[ends(h).first + 1];
    }
    for (std::size_t i = 1; i < first.size(); ++i) {
        first[i] += first[i - 1];
    }
    struct End {
        std::uint32_t upper;
        std::uint32_t half_edge;
    };
    std::vector<End> sorted(count);
    std::vector<std::uint32_t> next(first.begin(), first.end() - (first.empty() ? 0 : 1));
    for (std::size_t h = 0; h < count; ++h) {
        if (stop()) {
            return {};
        }
        const auto [a, b] = ends(h);
        sorted[next[a]++] = {b, std::uint32_t(h)};
    }
    std::vector<std::uint32_t> ring(count);
    for (std::size_t i = 0; i + 1 < first.size() && !stop(); ++i) {
        const auto begin = sorted.begin() + first[i];
        const auto end = sorted.begin() + first[i + 1];
        std::sort(begin, end, [](const End& a, const End& b) {
            return a.upper != b.upper ? a.upper < b.upper : a.half_edge < b.half_edge;
        });
        for (auto group = begin; group != end;) {
            auto at = group;
            while (at + 1 != end && (at + 1)->upper == group->upper) {
                ring[at->half_edge] = (at + 1)->half_edge;
                ++at;
            }
            ring[at->half_edge] = group->half_edge;
            group = at + 1;
        }
    }
    return ring;
}

} // namespace atrium
