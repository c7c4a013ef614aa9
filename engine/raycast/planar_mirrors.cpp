#include "engine/raycast/planar_mirrors.h"

#include "engine/geometry/planar_regions.h"

#include <algorithm>

namespace atrium {
namespace {

// A mirror doubles the angles of what it is bent by, so less of it passes for flat than with matt surfaces.
constexpr PlanarSettings kFlat{1e-4F, 0.999999F}; // 0.08 degrees
constexpr float kShadedFlat = 0.99999F;           // of a vertex normal with that of the plane: a quarter of a degree
constexpr double kSmallest = 1e-5;                // area relative to the square of the scene's diagonal
constexpr double kFills = 0.98;                   // of the rectangle

struct Piece {
    PlanarMirror mirror;
    std::vector<std::uint32_t> members;
};

bool shaded_flat(const RayScene& rays, std::uint32_t surface, std::uint32_t triangle, const vec3& normal) {
    Hit corner;
    corner.surface = surface;
    corner.triangle = triangle;
    corner.geometric_normal = normal;
    for (const vec2& b : {vec2(0, 0), vec2(1, 0), vec2(0, 1)}) {
        corner.barycentric = b;
        if (!(glm::dot(rays.shading_normal(corner), normal) >= kShadedFlat)) {
            return false;
        }
    }
    return true;
}

Piece make_piece(const RayScene& rays, std::uint32_t surface, const PlanarRegion& region,
                 std::span<const std::uint32_t> members) {
    Piece out;
    PlanarMirror& m = out.mirror;
    m.normal = region.normal;
    m.offset = glm::dot(region.normal, region.centroid);
    m.both_sides = rays.surfaces()[surface].back_side;
    m.surface = surface;
    const dvec3 u = glm::normalize(dvec3(region.axis) - glm::dot(dvec3(region.axis), region.normal) * region.normal);
    const dvec3 v = glm::cross(region.normal, u);
    dvec2 low(std::numeric_limits<double>::infinity());
    dvec2 high = -low;
    for (const std::uint32_t t : members) {
        if (!shaded_flat(rays, surface, t, vec3(region.normal))) {
            continue;
        }
        const auto p = rays.triangle(surface, t);
        for (const vec3& corner : p) {
            const dvec3 d = dvec3(corner) - region.centroid;
            const dvec2 at(glm::dot(d, u), glm::dot(d, v));
            low = glm::min(low, at);
            high = glm::max(high, at);
        }
        m.area += 0.5 * glm::length(glm::cross(dvec3(p[1]) - dvec3(p[0]), dvec3(p[2]) - dvec3(p[0])));
        out.members.push_back(t);
    }
    m.triangles = std::uint32_t(out.members.size());
    if (!out.members.empty()) {
        const auto corner = [&](double a, double b) { return vec3(region.centroid + a * u + b * v); };
        m.corner = {corner(low.x, low.y), corner(high.x, low.y), corner(high.x, high.y), corner(low.x, high.y)};
        m.fills = m.area >= kFills * (high.x - low.x) * (high.y - low.y);
    }
    return out;
}

} // namespace

PlanarMirrors::PlanarMirrors(const RayScene& rays, const RunContext& context) {
    const double diagonal = rays.bounds().diagonal();
    const double smallest = kSmallest * diagonal * diagonal;
    std::vector<Piece> pieces;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (classify(rays.material(s)) != MaterialKind::Mirror) {
            continue;
        }
        const RaySurface& surface = rays.surfaces()[s];
        const PlanarRegions found = planar_regions(*surface.positions, surface.triangles, kFlat, context);
        for (const PlanarRegion& region : found.regions) {
            if (region.area < smallest || context.should_stop()) {
                continue;
            }
            Piece piece = make_piece(rays, s, region, std::span(found.members).subspan(region.first, region.count));
            if (piece.mirror.area > 0.0 && piece.mirror.area >= smallest) {
                pieces.push_back(std::move(piece));
            }
        }
    }
    std::stable_sort(pieces.begin(), pieces.end(),
                     [](const Piece& a, const Piece& b) { return a.mirror.area > b.mirror.area; });
    pieces.resize(std::min(pieces.size(), kMost));
    mirror_of_.resize(pieces.empty() ? 0 : rays.surfaces().size());
    for (const Piece& piece : pieces) {
        std::vector<std::uint32_t>& mirror_of = mirror_of_[piece.mirror.surface];
        mirror_of.resize(rays.surfaces()[piece.mirror.surface].triangles.size(), kNone);
        for (const std::uint32_t t : piece.members) {
            mirror_of[t] = std::uint32_t(mirrors_.size());
        }
        mirrors_.push_back(piece.mirror);
    }
}

std::uint32_t PlanarMirrors::mirror_of(std::uint32_t surface, std::uint32_t triangle) const {
    return surface < mirror_of_.size() && triangle < mirror_of_[surface].size() ? mirror_of_[surface][triangle] : kNone;
}

std::uint32_t PlanarMirrors::mirror_at(const Hit& hit) const {
    const std::uint32_t mirror = hit ? mirror_of(hit.surface, hit.triangle) : kNone;
    return mirror != kNone && (hit.front || mirrors_[mirror].both_sides) ? mirror : kNone;
}

} // namespace atrium
