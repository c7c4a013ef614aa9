#include "engine/geometry/mesh_topology.h"

#include "engine/base/rng.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>

#include <cstring>
#include <unordered_map>

namespace atrium {
namespace {

using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<>;

struct PositionHash {
    std::size_t operator()(const vec3& p) const noexcept {
        std::uint32_t bits[3];
        std::memcpy(bits, &p, sizeof bits);
        return std::size_t(hash_combine(hash64(bits[0] | (std::uint64_t(bits[1]) << 32)), bits[2]));
    }
};

/// OpenMesh reports faces that it refuses on its error stream; for us that is an answer, not an error.
class QuietOpenMesh {
public:
    QuietOpenMesh() : was_enabled_(omerr().is_enabled()) { omerr().disable(); }
    ~QuietOpenMesh() {
        if (was_enabled_) {
            omerr().enable();
        }
    }
    QuietOpenMesh(const QuietOpenMesh&) = delete;
    QuietOpenMesh& operator=(const QuietOpenMesh&) = delete;

private:
    bool was_enabled_;
};

} // namespace

bool is_closed(const MeshData& mesh, const RunContext& context) {
    StopCheck stop(context, kMeshStride);
    const QuietOpenMesh quiet;
    HalfEdgeMesh half_edges;
    std::unordered_map<vec3, HalfEdgeMesh::VertexHandle, PositionHash> welded;
    const auto vertex = [&](std::uint32_t index) {
        const vec3 p = mesh.positions[index] + vec3(0.0F); // -0 becomes +0
        const auto [it, fresh] = welded.try_emplace(p);
        if (fresh) {
            it->second = half_edges.add_vertex({p.x, p.y, p.z});
        }
        return it->second;
    };
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        if (stop()) {
            return false;
        }
        const auto a = vertex(mesh.indices[i]);
        const auto b = vertex(mesh.indices[i + 1]);
        const auto c = vertex(mesh.indices[i + 2]);
        if (a != b && b != c && c != a && !half_edges.add_face(a, b, c).is_valid()) {
            return false;
        }
    }
    for (const auto edge : half_edges.edges()) {
        if (edge.is_boundary()) {
            return false;
        }
    }
    return half_edges.n_faces() > 0;
}

double signed_volume(const MeshData& mesh) {
    if (mesh.indices.empty()) {
        return 0.0;
    }
    const dvec3 o(mesh.positions[mesh.indices[0]]); // near the mesh: large coordinates do not cancel
    double sum = 0.0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const dvec3 a = dvec3(mesh.positions[mesh.indices[i]]) - o;
        const dvec3 b = dvec3(mesh.positions[mesh.indices[i + 1]]) - o;
        const dvec3 c = dvec3(mesh.positions[mesh.indices[i + 2]]) - o;
        sum += glm::dot(a, glm::cross(b, c));
    }
    return sum / 6.0;
}

} // namespace atrium
