#include "engine/particles/particle_paths.h"

#include "engine/base/checks.h"
#include "engine/base/parallel.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

constexpr std::size_t kGrain = 8192; // vertices, particles
constexpr std::size_t kBlock = 128;

/// A run of segments side by side: what the compiler can take four at a time.
struct SegmentBlock {
    std::array<float, kBlock + 1> x, y, z;
    std::array<float, kBlock> apart; ///< from the nearest box, 0 or less where they meet
};

// How far a segment is outside a box, positive where they are apart: by the axes that may separate them, without a division
// or a branch. The last three hold for any point of the segment's line; its start is near, where its end may be kFar away
// and would round badly.
inline float gap_between(const vec3& from, const vec3& to, const vec3& c, const vec3& e) {
    const float ax = from.x - c.x, ay = from.y - c.y, az = from.z - c.z;
    const float dx = to.x - from.x, dy = to.y - from.y, dz = to.z - from.z;
    const float bx = ax + dx, by = ay + dy, bz = az + dz;
    const float lx = std::abs(dx), ly = std::abs(dy), lz = std::abs(dz);
    float gap = std::max(std::min(ax, bx), -std::max(ax, bx)) - e.x;
    gap = std::max(gap, std::max(std::min(ay, by), -std::max(ay, by)) - e.y);
    gap = std::max(gap, std::max(std::min(az, bz), -std::max(az, bz)) - e.z);
    gap = std::max(gap, std::abs(dy * az - dz * ay) - (e.y * lz + e.z * ly));
    gap = std::max(gap, std::abs(dz * ax - dx * az) - (e.z * lx + e.x * lz));
    return std::max(gap, std::abs(dx * ay - dy * ax) - (e.x * ly + e.y * lx));
}

// Segments [i, i + 1) of a run of vertices.
void measure_gaps(SegmentBlock& s, const Box3& box) {
    const vec3 c = box.centre();
    const vec3 e = 0.5F * box.size();
    for (std::size_t i = 0; i < kBlock; ++i) {
        const float gap = gap_between({s.x[i], s.y[i], s.z[i]}, {s.x[i + 1], s.y[i + 1], s.z[i + 1]}, c, e);
        s.apart[i] = std::min(s.apart[i], gap);
    }
}

} // namespace

void ParticlePaths::add_vertices(std::span<const Ray> rays, std::vector<vec3>& out) {
    for (const Ray& r : rays) {
        out.push_back(r.origin);
    }
    if (!rays.empty()) {
        const Ray& last = rays.back();
        out.push_back(last.origin + last.direction * std::min(last.tmax, kFar));
    }
}

void ParticlePaths::reset(std::size_t particles, std::size_t vertices) {
    ATRIUM_CHECK(vertices < 0xFFFFFFFFU);
    for (std::vector<float>* v : {&x_, &y_, &z_}) {
        v->clear();
        v->reserve(vertices);
    }
    first_.assign(particles, 0);
    count_.assign(particles, 0);
    holes_ = 0;
}

void ParticlePaths::add(std::size_t particles) {
    first_.resize(first_.size() + particles, 0);
    count_.resize(first_.size(), 0);
}

void ParticlePaths::set(std::size_t particle, std::span<const vec3> path) {
    std::uint32_t& first = first_[particle];
    std::uint32_t& count = count_[particle];
    if (path.size() > count) {
        ATRIUM_CHECK(x_.size() + path.size() < 0xFFFFFFFFU);
        holes_ += count;
        first = std::uint32_t(x_.size());
        for (std::vector<float>* v : {&x_, &y_, &z_}) {
            v->resize(v->size() + path.size());
        }
    } else {
        holes_ += count - path.size();
    }
    count = std::uint32_t(path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
        x_[first + i] = path[i].x;
        y_[first + i] = path[i].y;
        z_[first + i] = path[i].z;
    }
}

void ParticlePaths::compact() {
    if (4 * holes_ <= x_.size()) {
        return;
    }
    for (std::vector<float>* v : {&x_, &y_, &z_}) {
        std::vector<float> packed;
        packed.reserve(vertices());
        for (std::size_t p = 0; p < first_.size(); ++p) {
            const auto from = v->begin() + first_[p];
            packed.insert(packed.end(), from, from + count_[p]);
        }
        *v = std::move(packed);
    }
    std::uint32_t at = 0;
    for (std::size_t p = 0; p < first_.size(); ++p) {
        first_[p] = at;
        at += count_[p];
    }
    holes_ = 0;
}

std::vector<vec3> ParticlePaths::path(std::size_t particle) const {
    std::vector<vec3> out;
    for (std::size_t i = first_[particle]; i < first_[particle] + count_[particle]; ++i) {
        out.emplace_back(x_[i], y_[i], z_[i]);
    }
    return out;
}

std::size_t ParticlePaths::memory_bytes() const {
    return 3 * x_.capacity() * sizeof(float) + (first_.capacity() + count_.capacity()) * sizeof(std::uint32_t);
}

std::vector<Box3> ParticlePaths::widened(std::span<const Box3> boxes, float reach) {
    const vec3 margin(1e-4F + 2e-6F * reach);
    std::vector<Box3> out;
    for (Box3 b : boxes) {
        if (!b.empty()) {
            b.min -= margin;
            b.max += margin;
            out.push_back(b);
        }
    }
    return out;
}

bool ParticlePaths::crosses(std::size_t particle, std::span<const Box3> boxes) const {
    for (std::size_t i = first_[particle]; i + 1 < first_[particle] + count_[particle]; ++i) {
        const vec3 from(x_[i], y_[i], z_[i]), to(x_[i + 1], y_[i + 1], z_[i + 1]);
        for (const Box3& box : boxes) {
            if (!(gap_between(from, to, box.centre(), 0.5F * box.size()) > 0.0F)) {
                return true;
            }
        }
    }
    return false;
}

void ParticlePaths::mark_crossing(std::span<const Box3> boxes, std::span<std::uint8_t> marks) const {
    ATRIUM_CHECK(marks.size() == size());
    if (boxes.empty() || x_.size() < 2) {
        return;
    }
    // Segments from one particle's end to the next one's start are looked at as well, which costs less than to leave them
    // out.
    std::vector<std::uint8_t> meets(x_.size(), 0);
    const std::size_t segments = x_.size() - 1;
    parallel_chunks(segments, kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        SegmentBlock block{}; // what is left over of the last one does no harm
        for (std::size_t i = begin; i < end; i += kBlock) {
            const std::size_t count = std::min(kBlock, end - i);
            std::copy_n(&x_[i], count + 1, block.x.begin());
            std::copy_n(&y_[i], count + 1, block.y.begin());
            std::copy_n(&z_[i], count + 1, block.z.begin());
            block.apart.fill(1.0F);
            for (const Box3& box : boxes) {
                measure_gaps(block, box);
            }
            for (std::size_t k = 0; k < count; ++k) {
                meets[i + k] = block.apart[k] > 0.0F ? 0 : 1;
            }
        }
    });
    parallel_chunks(size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t p = begin; p < end; ++p) {
            std::uint8_t any = marks[p];
            for (std::size_t i = first_[p]; i + 1 < first_[p] + count_[p]; ++i) {
                any |= meets[i];
            }
            marks[p] = any;
        }
    });
}

} // namespace atrium
