// Bounding volume hierarchy over one display mesh, for picking. Built lazily, on a worker where the mesh is large.
#pragma once

#include "engine/layers/surface_layer.h"

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace atrium::ui {

/// Which sides of a triangle a ray may hit.
enum class RaySides : std::uint8_t { Front, Both };

/// Hit on a mesh: t in units of the ray's direction, which need not be unit.
struct MeshHit {
    double t = 0;
    std::uint32_t triangle = 0;
    bool front = true;
};

/// Any thread may ask; the first one builds.
class MeshBvh {
public:
    explicit MeshBvh(std::shared_ptr<const DisplayMesh> mesh);

    [[nodiscard]] const DisplayMesh& mesh() const { return *mesh_; }
    [[nodiscard]] const Box3& bounds() const { return bounds_; }
    /// Nearest hit with 0 <= t < t_max in the mesh's own coordinates.
    [[nodiscard]] std::optional<MeshHit> nearest(const dvec3& origin, const dvec3& direction, double t_max,
                                                 RaySides sides) const;
    /// Builds now if nobody has yet.
    void build() const;

private:
    struct NodeBox {
        Box3 box;
        std::uint32_t first = 0; ///< first triangle of a leaf, else index of the first of two children
        std::uint32_t count = 0; ///< triangles of a leaf; 0 = inner
    };
    void split(std::uint32_t node, std::uint32_t begin, std::uint32_t end, std::vector<vec3>& centres) const;

    std::shared_ptr<const DisplayMesh> mesh_;
    Box3 bounds_;
    double gap_ = 0; ///< width of a gap between triangles that counts as closed
    mutable std::once_flag once_;
    mutable std::vector<NodeBox> nodes_;
    mutable std::vector<std::uint32_t> order_;
};

} // namespace atrium::ui
