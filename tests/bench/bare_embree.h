// Embree by itself on the triangles of a ray scene: the floor that our queries stand on.
#pragma once

#include "engine/raycast/ray_scene.h"

#include <memory>
#include <span>

namespace atrium::bench {

/// A segment from `origin` along a unit direction.
struct BareRay {
    vec3 origin{0.0F};
    vec3 direction{0.0F};
    float tnear = 0.0F;
    float tfar = 0.0F;
};

/// Built with the flags and the quality of RayScene, without its filters, normals, counts and offsets.
class BareEmbree {
public:
    explicit BareEmbree(const RayScene& rays);
    ~BareEmbree();
    BareEmbree(const BareEmbree&) = delete;
    BareEmbree& operator=(const BareEmbree&) = delete;

    /// Nearest hit of each ray; returns how many met something.
    [[nodiscard]] std::size_t nearest(std::span<const BareRay> rays) const;
    /// Whether something opaque is on each ray; returns on how many.
    [[nodiscard]] std::size_t occluded(std::span<const BareRay> rays) const;
    /// The same eight rays at a time; rays of a group should start at one point.
    [[nodiscard]] std::size_t occluded_by_8(std::span<const BareRay> rays) const;

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace atrium::bench
