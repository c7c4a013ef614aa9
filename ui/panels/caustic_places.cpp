#include "ui/panels/caustic_places.h"

#include <algorithm>

namespace atrium::ui {

std::optional<ChartRectangle> chart_rectangle(const CausticRow& row) {
    if (row.textures.empty() || row.record.boxes.empty()) {
        return std::nullopt;
    }
    // A box is known in both: from the largest one to the whole.
    std::size_t best = 0;
    const std::size_t count = std::min(row.textures.size(), row.record.boxes.size());
    const auto area = [&](std::size_t i) {
        const vec4& b = row.record.boxes[i];
        return (b.z - b.x) * (b.w - b.y);
    };
    for (std::size_t i = 1; i < count; ++i) {
        best = area(i) > area(best) ? i : best;
    }
    const vec4& b = row.record.boxes[best];
    const CausticTexture& t = *row.textures[best];
    const vec2 share(b.z - b.x, b.w - b.y);
    if (!(share.x > 0.0F && share.y > 0.0F)) {
        return std::nullopt;
    }
    const vec2 size = (t.high - t.low) / share;
    const vec2 low = t.low - vec2(b.x, b.y) * size;
    return ChartRectangle{low, low + size};
}

const SurfaceLayer* layer_of(const Solution& solution, const CausticRow& row) {
    const auto at = std::find_if(solution.surfaces.begin(), solution.surfaces.end(), [&](const auto& layer) {
        return layer->node == row.record.node && layer->part == row.record.part;
    });
    return at == solution.surfaces.end() ? nullptr : at->get();
}

namespace {

/// The texture that holds most light, as a rectangle of chart space; nothing without any.
std::optional<ChartRectangle> brightest(const CausticRow& row) {
    std::optional<ChartRectangle> out;
    double most = 0.0;
    for (const auto& t : row.textures) {
        // Some thousand texels tell enough of which is brightest.
        double sum = 0.0;
        std::size_t count = 0;
        for (std::uint32_t y = 0; y < t->height; y += std::max(t->height / 64, 1U)) {
            for (std::uint32_t x = 0; x < t->width; x += std::max(t->width / 64, 1U)) {
                sum += double(luminance(t->image[std::size_t(y) * t->width + x]));
                ++count;
            }
        }
        const vec2 size = t->high - t->low;
        const double power = count > 0 ? sum / double(count) * double(size.x) * double(size.y) : 0.0;
        if (!out || power > most) {
            most = power;
            out = ChartRectangle{t->low, t->high};
        }
    }
    return out;
}

bool inside(const vec2& uv, const ChartRectangle& r, float slack) {
    return uv.x >= r.low.x - slack && uv.y >= r.low.y - slack && uv.x <= r.high.x + slack && uv.y <= r.high.y + slack;
}

/// Area-weighted sums over triangles.
struct Facing {
    dvec3 place{0.0}, normal{0.0};
    double area = 0.0;
    void add(const dvec3& a, const dvec3& b, const dvec3& c) {
        const dvec3 n = 0.5 * glm::cross(b - a, c - a);
        const double size = glm::length(n);
        place += size * (a + b + c) / 3.0;
        normal += n;
        area += size;
    }
};

} // namespace

PiecePlace piece_place(const Scene& scene, const Solution& solution, const CausticRow& row) {
    PiecePlace out;
    const SurfaceLayer* layer = layer_of(solution, row);
    if (!scene.nodes.contains(row.record.node) || layer == nullptr) {
        out.bounds = scene.nodes.contains(row.record.node) ? scene.world_bounds(row.record.node) : DBox3();
        out.focus = out.bounds.empty() ? dvec3(0.0) : out.bounds.centre();
        return out;
    }
    const DisplayMesh& mesh = *layer->mesh;
    const dmat4 world = scene.world_matrix(row.record.node);
    const auto chart = chart_rectangle(row);
    const auto bright = brightest(row);
    constexpr float kSlack = 1e-2F; // tiles
    std::vector<dvec3> places(mesh.positions.size());
    DBox3 piece, all;
    for (std::size_t i = 0; i < places.size(); ++i) {
        places[i] = dvec3(world * dvec4(dvec3(mesh.positions[i]), 1.0));
        all.add(places[i]);
        if (chart && i < mesh.light_uv.size() && inside(mesh.light_uv[i], *chart, kSlack)) {
            piece.add(places[i]);
        }
    }
    out.bounds = piece.empty() ? all : piece;
    Facing lit, whole;
    for (std::size_t t = 0; t + 2 < mesh.indices.size(); t += 3) {
        const std::uint32_t* v = &mesh.indices[t];
        whole.add(places[v[0]], places[v[1]], places[v[2]]);
        if (bright && !mesh.light_uv.empty()) {
            const vec2 middle = (mesh.light_uv[v[0]] + mesh.light_uv[v[1]] + mesh.light_uv[v[2]]) / 3.0F;
            if (mesh.light_uv[v[0]].x >= 0.0F && inside(middle, *bright, kSlack)) {
                lit.add(places[v[0]], places[v[1]], places[v[2]]);
            }
        }
    }
    const Facing& facing = lit.area > 0.0 ? lit : whole;
    out.focus = lit.area > 0.0 ? lit.place / lit.area : out.bounds.centre();
    const double length = glm::length(facing.normal);
    if (length > 0.3 * facing.area) {
        const double side = (row.record.back ? -1.0 : 1.0) * (glm::determinant(dmat3(world)) < 0.0 ? -1.0 : 1.0);
        out.normal = side / length * facing.normal;
    }
    return out;
}

} // namespace atrium::ui
