#include "engine/layers/cover_border.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr int kHalvings = 5;
// What a covered vertex shows of the border's light at least and at most: beyond, a slope that was met within millimetres
// rules all the triangle.
constexpr float kLeast = 0.1F;
constexpr float kMost = 4.0F;
// An edge that is covered nearly from its open end says next to nothing of the other. Beside what edges say stands with this
// weight that it is dark there: so it is in slits, and elsewhere nobody sees it.
constexpr float kDark = 0.01F;

void find_border(const NodeMesh& mesh, const VertexSide& side, const SamplePlace& place, const CoveredAt& covered,
                 BorderEdge& edge) {
    const LightVertex& a = mesh.vertices[edge.open];
    const LightVertex& b = mesh.vertices[edge.covered];
    const vec3 from = place(a, side.normal(a)), to = place(b, side.normal(b));
    const auto normal_at = [&](float t) {
        const vec3 sum = side.normal(a) * (1.0F - t) + side.normal(b) * t;
        const float length = glm::length(sum);
        return length > 1e-6F ? sum / length : side.normal(a);
    };
    float open = 0.0F;
    float shut = 1.0F;
    for (int k = 0; k < kHalvings; ++k) {
        const float middle = 0.5F * (open + shut);
        (covered(from + (to - from) * middle, normal_at(middle)) ? shut : open) = middle;
    }
    edge.position = from + (to - from) * open;
    edge.normal = normal_at(open);
    // Samples lie a little beside their vertices: what counts is where the border is on the edge that is shown.
    const vec3 along = b.position - a.position;
    edge.at = std::clamp(glm::dot(edge.position - a.position, along) / std::max(glm::dot(along, along), 1e-20F), 0.0F, 1.0F);
    edge.length = glm::length(along);
}

// What a vertex shows so that the line to each open end passes through the light at the border.
Rgb beyond_border(const NodeMesh& mesh, DirectSample LightVertex::*sample, const BorderEdge* first, const BorderEdge* last,
                  DirectSample BorderEdge::*of_border) {
    Rgb right(0.0F);
    Rgb border(0.0F);
    float left = 0.0F;
    float lengths = 0.0F;
    for (const BorderEdge* e = first; e != last; ++e) {
        const Rgb& open = (mesh.vertices[e->open].*sample).irradiance;
        const Rgb& there = (e->*of_border).irradiance;
        right += (there - open * (1.0F - e->at)) * (e->length * e->at);
        left += e->length * e->at * e->at;
        border += there * e->length;
        lengths += e->length;
    }
    if (!(lengths > 0.0F)) {
        return first != last ? (first->*of_border).irradiance : Rgb(0.0F);
    }
    border /= lengths;
    const Rgb out = (right + border * (kLeast * kDark * lengths)) / (left + kDark * lengths);
    return glm::clamp(out, border * kLeast, border * kMost);
}

} // namespace

std::vector<BorderEdge> find_borders(const NodeMesh& mesh, const VertexSide& side, const SamplePlace& place,
                                     const CoveredAt& covered, const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    std::vector<BorderEdge> out;
    for (const MeshTriangle& t : mesh.triangles) {
        if (stop()) {
            return {};
        }
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = t.v[k], w = t.v[(k + 1) % 3];
            const LightVertex &a = mesh.vertices[v], &b = mesh.vertices[w];
            if (side.wanted(a) && side.covered(a) != side.covered(b)) {
                BorderEdge edge;
                edge.open = side.covered(a) ? w : v;
                edge.covered = side.covered(a) ? v : w;
                out.push_back(edge);
            }
        }
    }
    const auto key = [](const BorderEdge& e) { return std::pair(e.covered, e.open); };
    std::sort(out.begin(), out.end(), [&](const BorderEdge& x, const BorderEdge& y) { return key(x) < key(y); });
    out.erase(
        std::unique(out.begin(), out.end(), [&](const BorderEdge& x, const BorderEdge& y) { return key(x) == key(y); }),
        out.end());
    parallel_chunks(out.size(), 16, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            find_border(mesh, side, place, covered, out[i]);
        }
    });
    return out;
}

void fill_covered(NodeMesh& mesh, const VertexSide& side, DirectSample LightVertex::*sample,
                  const std::vector<BorderEdge>& borders, DirectSample BorderEdge::*of_border, StopCheck& stop) {
    std::vector<std::uint32_t> open;
    std::vector<std::uint8_t> empty(mesh.vertices.size(), 0); // still to be filled
    for (std::uint32_t v = 0; v < mesh.vertices.size() && !stop(); ++v) {
        empty[v] = side.covered(mesh.vertices[v]) ? 1 : 0;
    }
    for (std::size_t first = 0, last = 0; first < borders.size() && !stop(); first = last) {
        const std::uint32_t v = borders[first].covered;
        while (last < borders.size() && borders[last].covered == v) {
            ++last;
        }
        (mesh.vertices[v].*sample).irradiance =
            beyond_border(mesh, sample, borders.data() + first, borders.data() + last, of_border);
        empty[v] = 0;
    }
    for (std::uint32_t v = 0; v < mesh.vertices.size() && !stop(); ++v) {
        if (empty[v] != 0) {
            open.push_back(v);
        }
    }
    std::vector<Rgb> sum(open.empty() ? 0 : mesh.vertices.size());
    std::vector<float> count(sum.size());
    while (!open.empty()) {
        std::fill(sum.begin(), sum.end(), Rgb(0.0F));
        std::fill(count.begin(), count.end(), 0.0F);
        for (const MeshTriangle& t : mesh.triangles) {
            if (stop()) {
                return;
            }
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t to = t.v[k];
                for (const std::uint32_t from : {t.v[(k + 1) % 3], t.v[(k + 2) % 3]}) {
                    if (empty[to] != 0 && empty[from] == 0) {
                        sum[to] += (mesh.vertices[from].*sample).irradiance;
                        count[to] += 1.0F;
                    }
                }
            }
        }
        std::vector<std::uint32_t> left;
        for (const std::uint32_t v : open) {
            if (count[v] > 0.0F) {
                (mesh.vertices[v].*sample).irradiance = sum[v] / count[v];
                empty[v] = 0;
            } else {
                left.push_back(v);
            }
        }
        if (left.size() == open.size()) {
            break; // wholly enclosed: dark, and nobody sees it
        }
        open.swap(left);
    }
}

} // namespace atrium
