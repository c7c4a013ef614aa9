#include "engine/particles/specular_targets.h"

#include "engine/optics/specular.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

// A piece whose bounds are much larger than its surface is cut: particles for a dozen window panes in one mesh, or for the
// legs of a chair, would mostly pass between them.
constexpr float kLooseBounds = 3.0F;
constexpr std::size_t kMostPieces = 32; // of one surface

float bounds_area(const Box3& b) { // the mean area that a box shows is a quarter of its surface
    const vec3 s = b.size();
    return 0.5F * (s.x * s.y + s.y * s.z + s.z * s.x);
}

struct Piece {
    std::vector<std::uint32_t> triangles;
    Box3 bounds;
    float area = 0.0F;
};

Piece make_piece(const RayScene& rays, std::uint32_t surface, std::vector<std::uint32_t> triangles) {
    Piece out;
    for (const std::uint32_t t : triangles) {
        const auto p = rays.triangle(surface, t);
        out.area += 0.5F * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        for (const vec3& v : p) {
            out.bounds.add(v);
        }
    }
    out.triangles = std::move(triangles);
    return out;
}

} // namespace

SpecularTargets::SpecularTargets(const RayScene& rays) : of_triangle_(rays.surfaces().size()) {
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (!is_specular(rays.material(s))) {
            continue;
        }
        std::vector<std::uint32_t> all(rays.surfaces()[s].triangles.size());
        std::iota(all.begin(), all.end(), 0U);
        std::vector<Piece> pieces;
        pieces.push_back(make_piece(rays, s, std::move(all)));
        // The loosest piece is cut at the middle of its longest axis until all are compact.
        while (pieces.size() < kMostPieces) {
            std::size_t loosest = pieces.size();
            float most = 0.0F;
            for (std::size_t i = 0; i < pieces.size(); ++i) {
                const float excess = bounds_area(pieces[i].bounds) - 0.25F * kLooseBounds * 2.0F * pieces[i].area;
                if (pieces[i].triangles.size() > 1 && excess > most) {
                    most = excess;
                    loosest = i;
                }
            }
            if (loosest == pieces.size()) {
                break;
            }
            Piece cut = std::move(pieces[loosest]);
            const vec3 size = cut.bounds.size();
            const int axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
            const auto key = [&](std::uint32_t t) {
                const auto p = rays.triangle(s, t);
                return p[0][axis] + p[1][axis] + p[2][axis];
            };
            std::stable_sort(cut.triangles.begin(), cut.triangles.end(),
                             [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
            const auto middle = cut.triangles.begin() + std::ptrdiff_t(cut.triangles.size() / 2);
            pieces[loosest] = make_piece(rays, s, {cut.triangles.begin(), middle});
            pieces.push_back(make_piece(rays, s, {middle, cut.triangles.end()}));
        }
        of_triangle_[s].assign(rays.surfaces()[s].triangles.size(), kNone);
        for (std::uint32_t i = 0; i < pieces.size(); ++i) {
            for (const std::uint32_t t : pieces[i].triangles) {
                of_triangle_[s][t] = std::uint32_t(targets_.size());
            }
            targets_.push_back({pieces[i].bounds, pieces[i].area, s, i});
        }
    }
}

void SpecularTargets::follow(const RayScene& rays, std::span<const std::uint32_t> moved_surfaces) {
    of_triangle_.resize(rays.surfaces().size());
    for (const std::uint32_t s : moved_surfaces) {
        if (of_triangle_[s].empty()) {
            continue;
        }
        for (SpecularTarget& t : targets_) {
            t.bounds = t.surface == s ? Box3{} : t.bounds;
        }
        for (std::uint32_t i = 0; i < of_triangle_[s].size(); ++i) {
            for (const vec3& v : rays.triangle(s, i)) {
                targets_[of_triangle_[s][i]].bounds.add(v);
            }
        }
    }
}

} // namespace atrium
