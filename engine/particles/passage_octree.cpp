#include "engine/particles/passage_octree.h"

#include "engine/base/parallel.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 2048;
constexpr std::size_t kFewParticles = 256; // a cell with so few is not worth dividing

bool meet(const Box3& a, const Box3& b) {
    return a.min.x <= b.max.x && a.max.x >= b.min.x && a.min.y <= b.max.y && a.max.y >= b.min.y && a.min.z <= b.max.z &&
           a.max.z >= b.min.z;
}

Box3 octant(const Box3& box, std::uint32_t which) {
    const vec3 middle = box.centre();
    Box3 out = box;
    for (int k = 0; k < 3; ++k) {
        ((which >> k) & 1U ? out.min : out.max)[k] = middle[k];
    }
    return out;
}

Box3 grown(Box3 box, float by) {
    box.min -= vec3(by);
    box.max += vec3(by);
    return box;
}

} // namespace

PassageOctree::PassageOctree(float reach) : reach_(reach), cells_(1) {
    cells_[0].box.min = vec3(-reach);
    cells_[0].box.max = vec3(reach);
    cells_[0].used = true;
}

// A cell's particles are among its parent's. Cells count as a little larger, so that none is missed by rounding that meets a
// box within.
std::vector<std::uint32_t> PassageOctree::crossing(const ParticlePaths& paths, std::uint32_t parent, const Box3& box) const {
    const std::array<Box3, 1> wide{grown(box, 1e-4F * reach_)};
    std::vector<std::uint32_t> out;
    if (parent == 0) {
        std::vector<std::uint8_t> marks(paths.size(), 0);
        paths.mark_crossing(wide, marks);
        for (std::uint32_t i = 0; i < marks.size(); ++i) {
            if (marks[i] != 0) {
                out.push_back(i);
            }
        }
        return out;
    }
    const std::vector<std::uint32_t>& from = cells_[parent].crossing;
    std::vector<std::vector<std::uint32_t>> parts(chunk_count(from.size(), kGrain));
    parallel_chunks(from.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
        for (std::size_t i = begin; i < end; ++i) {
            if (paths.crosses(from[i], wide)) {
                parts[chunk].push_back(from[i]);
            }
        }
    });
    for (const auto& part : parts) {
        out.insert(out.end(), part.begin(), part.end());
    }
    return out;
}

void PassageOctree::refine(const ParticlePaths& paths, std::uint32_t cell, const Box3& box, float smallest) {
    const Box3 own = cells_[cell].box;
    if (max_component(own.size()) <= smallest || (cell != 0 && cells_[cell].crossing.size() <= kFewParticles)) {
        return;
    }
    for (std::uint32_t k = 0; k < 8; ++k) {
        const Box3 part = octant(own, k);
        if (!meet(part, box)) {
            continue;
        }
        if (cells_[cell].child[k] == 0) {
            std::vector<std::uint32_t> list = crossing(paths, cell, part);
            const auto free = std::find_if(cells_.begin(), cells_.end(), [](const Cell& c) { return !c.used; });
            const auto at = std::uint32_t(free - cells_.begin());
            if (free == cells_.end()) {
                cells_.emplace_back();
            }
            cells_[at] = {part, true, {}, std::move(list)};
            cells_[cell].child[k] = at;
        }
        refine(paths, cells_[cell].child[k], box, smallest);
    }
}

void PassageOctree::release(std::uint32_t cell) {
    for (const std::uint32_t c : cells_[cell].child) {
        if (c != 0) {
            release(c);
        }
    }
    cells_[cell] = {};
}

void PassageOctree::simplify(std::uint32_t cell, std::span<const Box3> near) {
    for (std::uint32_t& c : cells_[cell].child) {
        if (c == 0) {
            continue;
        }
        if (std::any_of(near.begin(), near.end(), [&](const Box3& b) { return meet(b, cells_[c].box); })) {
            simplify(c, near);
        } else {
            release(c);
            c = 0;
        }
    }
}

void PassageOctree::collect(std::uint32_t cell, const Box3& box, std::vector<std::uint8_t>& marks, bool& all) const {
    const Cell& own = cells_[cell];
    bool divided = true;
    for (std::uint32_t k = 0; k < 8; ++k) {
        divided = divided && (own.child[k] != 0 || !meet(octant(own.box, k), box));
    }
    if (!divided) {
        all = all || cell == 0;
        for (const std::uint32_t p : own.crossing) {
            marks[p] = 1;
        }
        return;
    }
    for (const std::uint32_t c : own.child) {
        if (c != 0 && meet(cells_[c].box, box)) {
            collect(c, box, marks, all);
        }
    }
}

void PassageOctree::mark_crossing(const ParticlePaths& paths, std::span<const Box3> boxes, std::span<std::uint8_t> marks) {
    std::vector<Box3> near;
    bool inside = true;
    for (const Box3& b : boxes) {
        const float size = max_component(b.size());
        near.push_back(grown(b, size));
        inside = inside && glm::all(glm::greaterThanEqual(b.min, cells_[0].box.min)) &&
                 glm::all(glm::lessThanEqual(b.max, cells_[0].box.max));
    }
    simplify(0, near);
    bool all = !inside;
    std::vector<std::uint8_t> candidate(paths.size(), 0);
    for (std::size_t i = 0; inside && i < boxes.size(); ++i) {
        refine(paths, 0, boxes[i], max_component(boxes[i].size()));
        collect(0, boxes[i], candidate, all);
    }
    if (all) {
        paths.mark_crossing(boxes, marks);
        return;
    }
    parallel_chunks(candidate.size(), 4 * kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end; ++i) {
            if (candidate[i] != 0 && paths.crosses(i, boxes)) {
                marks[i] = 1;
            }
        }
    });
}

void PassageOctree::follow(const ParticlePaths& paths, std::span<const std::uint32_t> particles) {
    parallel_chunks(cells_.size(), 1, [&](std::size_t c, std::size_t, std::size_t) {
        Cell& cell = cells_[c];
        if (c == 0 || !cell.used) {
            return;
        }
        const std::array<Box3, 1> wide{grown(cell.box, 1e-4F * reach_)};
        std::vector<std::uint32_t> out;
        std::size_t at = 0;
        for (const std::uint32_t p : particles) {
            for (; at < cell.crossing.size() && cell.crossing[at] < p; ++at) {
                out.push_back(cell.crossing[at]);
            }
            at += at < cell.crossing.size() && cell.crossing[at] == p ? 1 : 0;
            if (paths.crosses(p, wide)) {
                out.push_back(p);
            }
        }
        out.insert(out.end(), cell.crossing.begin() + std::ptrdiff_t(at), cell.crossing.end());
        cell.crossing = std::move(out);
    });
}

std::size_t PassageOctree::cells() const {
    return std::size_t(std::count_if(cells_.begin(), cells_.end(), [](const Cell& c) { return c.used; }));
}

std::vector<PassageOctree::Leaf> PassageOctree::leaves() const {
    std::vector<Leaf> out;
    for (std::size_t i = 1; i < cells_.size(); ++i) {
        const Cell& cell = cells_[i];
        if (cell.used && std::all_of(cell.child.begin(), cell.child.end(), [](std::uint32_t c) { return c == 0; })) {
            out.push_back({cell.box, cell.crossing.size()});
        }
    }
    return out;
}

std::size_t PassageOctree::memory_bytes() const {
    std::size_t bytes = cells_.capacity() * sizeof(Cell);
    for (const Cell& c : cells_) {
        bytes += c.crossing.capacity() * sizeof(std::uint32_t);
    }
    return bytes;
}

} // namespace atrium
