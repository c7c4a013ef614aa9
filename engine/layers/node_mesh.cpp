#include "engine/layers/node_mesh.h"

namespace atrium {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// Index of a triangle's longest edge; of equal ones the one with the smallest welded key, so that neighbours agree.
std::size_t longest_edge(const NodeMesh& mesh, const MeshTriangle& t) {
    std::size_t best = 0;
    float best_length = -1.0F;
    std::uint64_t best_key = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = t.v[k], b = t.v[(k + 1) % 3];
        const float length = edge_length(mesh, a, b);
        const std::uint64_t key = edge_key(mesh.vertices[a].weld, mesh.vertices[b].weld);
        if (length > best_length || (length == best_length && key < best_key)) {
            best = k;
            best_length = length;
            best_key = key;
        }
    }
    return best;
}

} // namespace

void add_triangle(NodeMesh& mesh, const MeshTriangle& t) {
    mesh.triangles.push_back(t);
    const vec3 centroid =
        (mesh.vertices[t.v[0]].position + mesh.vertices[t.v[1]].position + mesh.vertices[t.v[2]].position) / 3.0F;
    for (const std::uint32_t v : t.v) {
        mesh.vertices[v].towards += centroid - mesh.vertices[v].position;
        mesh.vertices[v].triangles += 1.0F;
    }
}

LightVertex midpoint(const LightVertex& a, const LightVertex& b) {
    LightVertex m;
    m.local = 0.5F * (a.local + b.local);
    m.position = 0.5F * (a.position + b.position);
    const auto mean_normal = [](const vec3& p, const vec3& q) {
        const vec3 sum = p + q;
        const float length = glm::length(sum);
        return length > 1e-6F ? sum / length : p;
    };
    m.local_normal = mean_normal(a.local_normal, b.local_normal);
    m.normal = mean_normal(a.normal, b.normal);
    m.uv0 = 0.5F * (a.uv0 + b.uv0);
    m.uv1 = 0.5F * (a.uv1 + b.uv1);
    m.light_uv = 0.5F * (a.light_uv + b.light_uv);
    m.color = 0.5F * (a.color + b.color);
    m.wants_back = a.wants_back;
    m.unlit = a.unlit;
    return m;
}

float edge_length(const NodeMesh& mesh, std::uint32_t a, std::uint32_t b) {
    return glm::length(mesh.vertices[a].position - mesh.vertices[b].position);
}

void close_split(NodeMesh& mesh, SplitSet& split, StopCheck& stop) {
    for (bool grown = !split.empty(); grown;) {
        grown = false;
        for (MeshTriangle& t : mesh.triangles) {
            if (stop()) {
                return;
            }
            bool any = false;
            for (std::size_t k = 0; k < 3 && !any; ++k) {
                any = split.contains(edge_key(mesh.vertices[t.v[k]].weld, mesh.vertices[t.v[(k + 1) % 3]].weld));
            }
            if (!any) {
                continue;
            }
            t.open = true;
            const std::size_t k = longest_edge(mesh, t);
            const std::uint64_t key = edge_key(mesh.vertices[t.v[k]].weld, mesh.vertices[t.v[(k + 1) % 3]].weld);
            const auto [it, fresh] = split.try_emplace(key, mesh.welds);
            mesh.welds += fresh ? 1 : 0;
            grown = grown || fresh;
        }
    }
}

std::size_t cut(NodeMesh& mesh, const SplitSet& split, Middles& middles, StopCheck& stop) {
    std::size_t made = 0;
    std::vector<MeshTriangle> old;
    old.swap(mesh.triangles);
    for (LightVertex& v : mesh.vertices) {
        v.towards = vec3(0.0F);
        v.triangles = 0.0F;
    }
    const auto middle_of = [&](std::uint32_t a, std::uint32_t b) -> std::uint32_t {
        const auto it = split.find(edge_key(mesh.vertices[a].weld, mesh.vertices[b].weld));
        if (it == split.end()) {
            return kNone;
        }
        const auto [middle, fresh] = middles.try_emplace(edge_key(a, b), 0);
        if (fresh) {
            middle->second = std::uint32_t(mesh.vertices.size());
            mesh.vertices.push_back(midpoint(mesh.vertices[a], mesh.vertices[b]));
            ++made;
        }
        mesh.vertices[middle->second].weld = it->second;
        return middle->second;
    };
    for (const MeshTriangle& t : old) {
        if (stop()) {
            return made;
        }
        if (!t.open) {
            add_triangle(mesh, t);
            continue;
        }
        std::array<std::uint32_t, 3> m{};
        unsigned count = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            m[k] = middle_of(t.v[k], t.v[(k + 1) % 3]);
            count += m[k] != kNone ? 1 : 0;
        }
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            add_triangle(mesh, {{a, b, c}, t.surface, true});
        };
        if (count == 0) {
            MeshTriangle closed = t;
            closed.open = false;
            add_triangle(mesh, closed);
        } else if (count == 3) {
            add(t.v[0], m[0], m[2]);
            add(m[0], t.v[1], m[1]);
            add(m[2], m[1], t.v[2]);
            add(m[0], m[1], m[2]);
        } else {
            // close_split() has seen to it that the longest edge is among those split: halve there first, then the half
            // that has the other split edge. Angles stay bounded however often this is done (Rivara 1984).
            const std::size_t k = longest_edge(mesh, t);
            const std::uint32_t a = t.v[k], b = t.v[(k + 1) % 3], c = t.v[(k + 2) % 3];
            const std::uint32_t ab = m[k], bc = m[(k + 1) % 3], ca = m[(k + 2) % 3];
            if (ca != kNone) {
                add(a, ab, ca);
                add(ca, ab, c);
            } else {
                add(a, ab, c);
            }
            if (bc != kNone) {
                add(ab, b, bc);
                add(ab, bc, c);
            } else {
                add(ab, b, c);
            }
        }
    }
    return made;
}

} // namespace atrium
