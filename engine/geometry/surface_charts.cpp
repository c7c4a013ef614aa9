#include "engine/geometry/surface_charts.h"

#include "engine/base/checks.h"
#include "engine/geometry/planar_regions.h"

#include <algorithm>
#include <numeric>

namespace atrium {
namespace {

constexpr std::uint32_t kNone = SurfaceCharts::kNone;
constexpr std::uint64_t kMostTiles = 65535;
constexpr std::size_t kMostCharts = 16384; // of one tile or more each: leaves the packing room

/// A chart before it has a place: its rectangle in metres and coordinates relative to the rectangle's corner.
struct Piece {
    Chart chart;
    vec2 size{0.0F}; ///< metres
    std::vector<std::uint32_t> triangles;
};

class Assembler {
public:
    Assembler(std::span<const vec3> positions, std::span<const uvec3> triangles, std::span<const vec2> domain,
              const ChartSettings& settings, const RunContext& context)
        : positions_(positions), triangles_(triangles), domain_(domain), settings_(settings), context_(context),
          stop_(context, kMeshStride) {
        out_.tile_edge = settings.tile_edge;
        out_.chart_of_triangle.assign(triangles.size(), kNone);
        out_.uv.resize(triangles.size()); // metres in the piece's rectangle until it is placed
    }

    SurfaceCharts run() {
        std::vector<std::uint32_t> flat;
        std::vector<std::uint32_t> curved;
        for (std::uint32_t t = 0; t < triangles_.size() && !stop_(); ++t) {
            (on_curved_side(t) ? curved : flat).push_back(t);
        }
        if (!curved.empty()) {
            add_curved(std::move(curved));
        }
        if (!flat.empty()) {
            add_planar(flat);
        }
        if (context_.should_stop()) {
            return {};
        }
        drop_smallest();
        pack();
        place();
        return std::move(out_);
    }

private:
    [[nodiscard]] bool on_curved_side(std::uint32_t t) const {
        if (domain_.empty()) {
            return false;
        }
        const uvec3& i = triangles_[t];
        return domain_[i.x].x >= 0.0F && domain_[i.y].x >= 0.0F && domain_[i.z].x >= 0.0F;
    }

    [[nodiscard]] bool worth_a_chart(const vec2& size, double area) const {
        const float longer = std::max(size.x, size.y);
        return longer >= settings_.smallest_extent && longer > 0.0F &&
               area >= double(settings_.smallest_width) * double(longer);
    }

    void add_planar(const std::vector<std::uint32_t>& flat) {
        std::vector<uvec3> some;
        if (flat.size() < triangles_.size()) {
            for (const std::uint32_t t : flat) {
                some.push_back(triangles_[t]);
            }
        }
        const std::span<const uvec3> given = some.empty() ? triangles_ : std::span<const uvec3>(some);
        const PlanarRegions divided = planar_regions(positions_, given, {settings_.flatness}, context_);
        for (const PlanarRegion& region : divided.regions) {
            if (stop_()) {
                return;
            }
            add_region(region, std::span(divided.members).subspan(region.first, region.count), flat);
        }
    }

    void add_region(const PlanarRegion& region, std::span<const std::uint32_t> members,
                    const std::vector<std::uint32_t>& flat) {
        const vec3 n(region.normal);
        const vec3 along = region.axis;
        const vec3 across = glm::cross(n, along);
        vec2 low(std::numeric_limits<float>::infinity());
        vec2 high(-std::numeric_limits<float>::infinity());
        const vec3 centre(region.centroid);
        for (const std::uint32_t m : members) {
            if (stop_()) {
                return;
            }
            const uvec3& i = triangles_[flat[m]];
            for (int k = 0; k < 3; ++k) {
                const vec3 p = positions_[i[k]] - centre;
                const vec2 q(glm::dot(p, along), glm::dot(p, across));
                low = glm::min(low, q);
                high = glm::max(high, q);
            }
        }
        if (!worth_a_chart(high - low, region.area)) {
            return;
        }
        // u along the longer side.
        const bool turn = high.y - low.y > high.x - low.x;
        Piece piece;
        Chart& chart = piece.chart;
        chart.normal = n;
        chart.axis_u = turn ? across : along;
        chart.axis_v = turn ? -along : across;
        const vec2 corner = turn ? vec2(low.y, -high.x) : low;
        piece.size = turn ? vec2(high.y - low.y, high.x - low.x) : high - low;
        chart.origin = centre + chart.axis_u * corner.x + chart.axis_v * corner.y;
        chart.area = float(region.area);
        piece.triangles.reserve(members.size());
        for (const std::uint32_t m : members) {
            const std::uint32_t t = flat[m];
            piece.triangles.push_back(t);
            for (int k = 0; k < 3; ++k) {
                const vec3 p = positions_[triangles_[t][k]] - centre;
                out_.uv[t][std::size_t(k)] = vec2(glm::dot(p, chart.axis_u), glm::dot(p, chart.axis_v)) - corner;
            }
        }
        pieces_.push_back(std::move(piece));
    }

    // The side's rectangle is as wide and high as where it is widest and highest.
    void add_curved(std::vector<std::uint32_t> members) {
        vec2 size(0.0F);
        double area = 0.0;
        for (const std::uint32_t t : members) {
            const uvec3& i = triangles_[t];
            const vec3 p1 = positions_[i.y] - positions_[i.x], p2 = positions_[i.z] - positions_[i.x];
            const vec2 d1 = domain_[i.y] - domain_[i.x], d2 = domain_[i.z] - domain_[i.x];
            area += 0.5 * double(glm::length(glm::cross(p1, p2)));
            const float determinant = d1.x * d2.y - d1.y * d2.x;
            if (std::abs(determinant) > 1e-12F) {
                size = glm::max(size, vec2(glm::length(p1 * d2.y - p2 * d1.y), glm::length(p2 * d1.x - p1 * d2.x)) /
                                          std::abs(determinant));
            }
        }
        if (!worth_a_chart(size, area)) {
            return;
        }
        Piece piece;
        piece.chart.planar = false;
        piece.chart.area = float(area);
        piece.size = size;
        for (const std::uint32_t t : members) {
            for (int k = 0; k < 3; ++k) {
                out_.uv[t][std::size_t(k)] = domain_[triangles_[t][k]] * size;
            }
        }
        piece.triangles = std::move(members);
        pieces_.push_back(std::move(piece));
    }

    void drop_smallest() {
        if (pieces_.size() <= kMostCharts) {
            return;
        }
        std::stable_sort(pieces_.begin(), pieces_.end(),
                         [](const Piece& a, const Piece& b) { return a.chart.area > b.chart.area; });
        pieces_.resize(kMostCharts);
        std::sort(pieces_.begin(), pieces_.end(),
                  [](const Piece& a, const Piece& b) { return a.triangles.front() < b.triangles.front(); });
    }

    // Shelves from high to low; larger tiles when they do not fit.
    void pack() {
        std::vector<std::uint32_t> order(pieces_.size());
        std::iota(order.begin(), order.end(), 0U);
        while (!pieces_.empty()) {
            std::uint64_t tiles = 0;
            std::uint32_t widest = 0;
            for (Piece& piece : pieces_) {
                // A rectangle a rounding longer than whole tiles is whole tiles long.
                const auto whole = [&](float metres) {
                    return std::uint32_t(std::clamp(std::ceil(metres / out_.tile_edge - 1e-4F), 1.0F, 1e6F));
                };
                piece.chart.tiles_u = whole(piece.size.x);
                piece.chart.tiles_v = whole(piece.size.y);
                tiles += std::uint64_t(piece.chart.tiles_u) * piece.chart.tiles_v;
                widest = std::max(widest, piece.chart.tiles_u);
            }
            std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
                return pieces_[a].chart.tiles_v > pieces_[b].chart.tiles_v;
            });
            out_.width = std::max(widest, std::uint32_t(std::ceil(std::sqrt(double(tiles)))));
            std::uint32_t u = 0, v = 0, shelf = 0;
            for (const std::uint32_t i : order) {
                Chart& chart = pieces_[i].chart;
                if (u + chart.tiles_u > out_.width) {
                    v += shelf;
                    u = shelf = 0;
                }
                chart.tile_u = u;
                chart.tile_v = v;
                u += chart.tiles_u;
                shelf = std::max(shelf, chart.tiles_v);
            }
            out_.height = v + shelf;
            if (std::uint64_t(out_.width) * out_.height <= kMostTiles) {
                return;
            }
            out_.tile_edge *= 2.0F;
        }
    }

    void place() {
        // A few roundings inside the rectangle: see SurfaceCharts.
        const float margin = 4.0F * std::numeric_limits<float>::epsilon() * float(std::max(out_.width, out_.height));
        for (Piece& piece : pieces_) {
            Chart& chart = piece.chart;
            const auto id = std::uint32_t(out_.charts.size());
            const vec2 tiles(float(chart.tiles_u), float(chart.tiles_v));
            chart.scale = chart.planar ? vec2(out_.tile_edge) : piece.size / tiles;
            const vec2 corner(float(chart.tile_u), float(chart.tile_v));
            for (const std::uint32_t t : piece.triangles) {
                out_.chart_of_triangle[t] = id;
                for (vec2& uv : out_.uv[t]) {
                    uv = glm::clamp(corner + uv / chart.scale, corner + margin, corner + tiles - margin);
                }
            }
            out_.charts.push_back(chart);
        }
        for (std::size_t t = 0; t < out_.uv.size(); ++t) {
            if (out_.chart_of_triangle[t] == kNone) {
                out_.uv[t] = {};
            }
        }
    }

    std::span<const vec3> positions_;
    std::span<const uvec3> triangles_;
    std::span<const vec2> domain_;
    ChartSettings settings_;
    const RunContext& context_;
    StopCheck stop_;
    SurfaceCharts out_;
    std::vector<Piece> pieces_;
};

} // namespace

SurfaceCharts build_charts(std::span<const vec3> positions, std::span<const uvec3> triangles, std::span<const vec2> domain,
                           const ChartSettings& settings, const RunContext& context) {
    ATRIUM_CHECK(domain.empty() || domain.size() == positions.size());
    return Assembler(positions, triangles, domain, settings, context).run();
}

std::vector<vec2> curved_domain(const Geometry& geometry, const MeshData& mesh) {
    if (std::holds_alternative<Sphere>(geometry)) {
        return mesh.texcoords0;
    }
    if (!std::holds_alternative<Cylinder>(geometry) && !std::holds_alternative<Cone>(geometry)) {
        return {};
    }
    // The side comes first, in two rows; on flat ends the normal is along the axis.
    std::vector<vec2> out = mesh.texcoords0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        const vec3& n = mesh.normals[i];
        if (n.x == 0.0F && n.z == 0.0F) {
            out[i] = vec2(-1.0F);
        }
    }
    return out;
}

} // namespace atrium
