#include "engine/debug/octree_view.h"

#include "engine/particles/passage_octree.h"
#include "engine/solver/insides.h"

#include <algorithm>

namespace atrium {
namespace {

Box3 bounds_of(const RaySurface& surface) {
    Box3 out;
    for (const uvec3& t : surface.triangles) {
        for (int k = 0; k < 3; ++k) {
            out.add((*surface.positions)[t[k]]);
        }
    }
    return out;
}

} // namespace

OctreeView view_octree(const Solution& solution, const std::unordered_set<NodeId>& of) {
    OctreeView out;
    if (!solution.insides || !solution.insides->paths) {
        return out;
    }
    const Insides& in = *solution.insides;
    out.particles = in.paths->size();
    Box3 all; // as an object moves: all of it at once
    for (const RaySurface& surface : in.surfaces) {
        if (of.contains(surface.node) && surface.positions) {
            const Box3 own = bounds_of(surface);
            if (!own.empty()) {
                all.add(own);
            }
        }
    }
    if (all.empty()) {
        return out;
    }
    const std::vector<Box3> wide = ParticlePaths::widened(std::array{all}, in.reach);
    PassageOctree tree(in.reach);
    std::vector<std::uint8_t> marks(in.paths->size(), 0);
    tree.mark_crossing(*in.paths, wide, marks);
    out.touched = std::size_t(std::count(marks.begin(), marks.end(), std::uint8_t(1)));
    const auto world = [&](const vec3& p) { return dvec3(p) + in.origin; };
    for (const PassageOctree::Leaf& leaf : tree.leaves()) {
        out.cells.push_back({{world(leaf.box.min), world(leaf.box.max)}, leaf.particles});
        out.scan += leaf.particles;
    }
    return out;
}

} // namespace atrium
