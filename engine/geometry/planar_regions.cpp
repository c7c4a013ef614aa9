#include "engine/geometry/planar_regions.h"

#include "engine/geometry/welding.h"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>

namespace atrium {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr int kMostOnEdge = 64;         // neighbours looked at on one edge; more is no surface
constexpr float kWeldTolerance = 2e-6F; // of the extents
constexpr float kRounding = 5e-7F;      // of the largest coordinate: what float leaves of a plane
constexpr double kNormalCells = 50.0;   // cells of about one degree; axis directions are in their middles
constexpr int kHostsPerPlane = 8;       // planes told apart among pieces of like normal and distance
constexpr int kMergeRounds = 8;
constexpr std::size_t kDirections = 180; // half degrees of a right angle

class Divider {
public:
    Divider(std::span<const vec3> positions, std::span<const uvec3> triangles, const PlanarSettings& settings,
            const RunContext& context)
        : settings_(settings), context_(context), stop_(context, kMeshStride) {
        Box3 box;
        float largest = 0.0F;
        for (const uvec3& t : triangles) {
            for (int k = 0; k < 3; ++k) {
                box.add(positions[t[k]]);
                largest = std::max(largest, max_component(glm::abs(positions[t[k]])));
            }
        }
        mesh_ = weld(positions, triangles, kWeldTolerance * box.diagonal(), context);
        if (context.should_stop()) {
            return;
        }
        rings_ = edge_rings(mesh_, context);
        tolerance_ = std::max(settings.flatness, kRounding * largest);
    }

    PlanarRegions run() {
        for (const auto step : {&Divider::measure, &Divider::grow_all, &Divider::merge_coplanar}) {
            if (context_.should_stop()) {
                return {};
            }
            (this->*step)();
        }
        PlanarRegions out;
        if (!context_.should_stop()) {
            out = collect();
        }
        return context_.should_stop() ? PlanarRegions{} : std::move(out);
    }

private:
    [[nodiscard]] const vec3& corner(std::uint32_t t, std::uint32_t k) const {
        return mesh_.points[mesh_.triangles[t][int(k)]];
    }

    void measure() {
        const std::size_t n = mesh_.triangles.size();
        normal_.resize(n);
        area_.resize(n);
        for (std::uint32_t t = 0; t < n && !stop_(); ++t) {
            const vec3 cross = glm::cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
            const float length = glm::length(cross);
            area_[t] = 0.5F * length;
            normal_[t] = length > 0.0F ? cross / length : vec3(0.0F);
        }
    }

    // Seeds from large to small: a large triangle knows its plane best. Sizes count by their binary exponent.
    [[nodiscard]] std::vector<std::uint32_t> seeds() const {
        std::array<std::uint32_t, 257> start{};
        const auto rank = [&](std::uint32_t t) { return 255U - (std::bit_cast<std::uint32_t>(area_[t]) >> 23U); };
        for (std::uint32_t t = 0; t < area_.size(); ++t) {
            ++start[rank(t) + 1];
        }
        std::partial_sum(start.begin(), start.end(), start.begin());
        std::vector<std::uint32_t> out(area_.size());
        for (std::uint32_t t = 0; t < area_.size(); ++t) {
            out[start[rank(t)]++] = t;
        }
        return out;
    }

    void grow_all() {
        region_of_.assign(area_.size(), kNone);
        members_.reserve(area_.size());
        std::vector<std::uint32_t> order = seeds();
        for (std::size_t i = 0; i < order.size() && !stop_(); ++i) {
            if (region_of_[order[i]] == kNone && area_[order[i]] > 0.0F) {
                grow(order[i], order);
            }
        }
    }

    // Every member is within the tolerances of the mean plane at the time; that lags behind the front, so a finely divided
    // cylinder ends up in strips and not in one. Members that the final plane has left behind are taken off and become
    // `later` seeds.
    void grow(std::uint32_t seed, std::vector<std::uint32_t>& later) {
        const auto id = std::uint32_t(regions_.size());
        PlanarRegion region;
        region.first = std::uint32_t(members_.size());
        dvec3 normal_sum(0.0), centre_sum(0.0);
        vec3 normal(0.0F), centre(0.0F);
        double next_fit = 0.0;
        const auto add = [&](std::uint32_t t) {
            region_of_[t] = id;
            members_.push_back(t);
            const double a = area_[t];
            region.area += a;
            normal_sum += a * dvec3(normal_[t]);
            centre_sum += a / 3.0 * (dvec3(corner(t, 0)) + dvec3(corner(t, 1)) + dvec3(corner(t, 2)));
            if (region.area >= next_fit) {
                next_fit = 2.0 * region.area;
                normal = vec3(glm::normalize(normal_sum));
                centre = vec3(centre_sum / region.area);
            }
        };
        add(seed);
        for (std::size_t at = region.first; at < members_.size() && !stop_(); ++at) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const std::uint32_t h = 3 * members_[at] + k;
                std::uint32_t g = rings_[h];
                for (int steps = 0; g != h && steps < kMostOnEdge; g = rings_[g], ++steps) {
                    const std::uint32_t t = g / 3;
                    if (region_of_[t] == kNone && area_[t] > 0.0F && glm::dot(normal_[t], normal) >= settings_.cos_angle &&
                        std::abs(glm::dot(corner(t, (g % 3 + 2) % 3) - centre, normal)) <= tolerance_) {
                        add(t);
                    }
                }
            }
        }
        region.normal = glm::normalize(normal_sum);
        region.centroid = centre_sum / region.area;
        const auto kept = std::stable_partition(members_.begin() + region.first, members_.end(), [&](std::uint32_t t) {
            return t == seed || farthest(t, region) <= 1.5 * double(tolerance_);
        });
        for (auto t = kept; t != members_.end(); ++t) {
            region_of_[*t] = kNone;
            region.area -= double(area_[*t]);
            later.push_back(*t);
        }
        members_.erase(kept, members_.end());
        region.count = std::uint32_t(members_.size()) - region.first;
        regions_.push_back(region);
    }

    [[nodiscard]] double farthest(std::uint32_t t, const PlanarRegion& plane) const {
        double most = 0.0;
        for (std::uint32_t k = 0; k < 3; ++k) {
            most = std::max(most, std::abs(glm::dot(dvec3(corner(t, k)) - plane.centroid, plane.normal)));
        }
        return most;
    }

    // Pieces sorted by normal (in cells) and distance; each group of like distance is then looked at by itself.
    void merge_coplanar() {
        merged_.resize(regions_.size());
        std::iota(merged_.begin(), merged_.end(), 0U);
        struct Key {
            std::uint32_t cell;
            std::uint32_t region;
            double distance;
        };
        std::vector<Key> keys(regions_.size());
        for (std::uint32_t r = 0; r < regions_.size(); ++r) {
            const dvec3 cell = glm::floor(regions_[r].normal * kNormalCells + 0.5) + 64.0;
            keys[r] = {std::uint32_t(cell.x) << 16U | std::uint32_t(cell.y) << 8U | std::uint32_t(cell.z), r, 0.0};
        }
        std::sort(keys.begin(), keys.end(),
                  [](const Key& a, const Key& b) { return a.cell != b.cell ? a.cell < b.cell : a.region < b.region; });
        std::vector<std::uint32_t> group;
        for (auto begin = keys.begin(); begin != keys.end();) {
            dvec3 mean(0.0);
            auto end = begin;
            for (; end != keys.end() && end->cell == begin->cell; ++end) {
                mean += regions_[end->region].normal * regions_[end->region].area;
            }
            for (auto k = begin; k != end; ++k) {
                k->distance = glm::dot(glm::normalize(mean), regions_[k->region].centroid);
            }
            std::sort(begin, end, [](const Key& a, const Key& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.region < b.region;
            });
            for (auto k = begin; k != end && !stop_(); ++k) {
                group.push_back(k->region);
                if (k + 1 == end || (k + 1)->distance - k->distance > double(tolerance_)) {
                    merge_group(group);
                    group.clear();
                }
            }
            begin = end;
        }
    }

    void merge_group(std::vector<std::uint32_t>& group) {
        for (int round = 0; round < kHostsPerPlane && group.size() > 1; ++round) {
            const std::uint32_t host = *std::max_element(group.begin(), group.end(), [&](std::uint32_t a, std::uint32_t b) {
                return regions_[a].area != regions_[b].area ? regions_[a].area < regions_[b].area : a > b;
            });
            const vec3 u = main_direction(host);
            const vec3 v = glm::cross(vec3(regions_[host].normal), u);
            std::vector<Boxed> on_plane;
            std::vector<std::uint32_t> others;
            for (const std::uint32_t r : group) {
                Boxed boxed{r, vec2(std::numeric_limits<float>::infinity()), vec2(-std::numeric_limits<float>::infinity())};
                fits(r, host, u, v, boxed) ? on_plane.push_back(boxed) : others.push_back(r);
            }
            merge_touching(on_plane);
            group = std::move(others);
        }
    }

    struct Boxed {
        std::uint32_t region;
        vec2 low;
        vec2 high;
    };

    // Whether all of a piece is in the host's plane; its rectangle in the host's axes.
    [[nodiscard]] bool fits(std::uint32_t r, std::uint32_t host, const vec3& u, const vec3& v, Boxed& box) const {
        if (glm::dot(regions_[r].normal, regions_[host].normal) < double(settings_.cos_angle)) {
            return false;
        }
        const vec3 centre(regions_[host].centroid);
        const vec3 normal(regions_[host].normal);
        for (std::uint32_t i = 0; i < regions_[r].count && !stop_(); ++i) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                const vec3 p = corner(members_[regions_[r].first + i], k) - centre;
                if (std::abs(glm::dot(p, normal)) > tolerance_) {
                    return false;
                }
                const vec2 q(glm::dot(p, u), glm::dot(p, v));
                box.low = glm::min(box.low, q);
                box.high = glm::max(box.high, q);
            }
        }
        return true;
    }

    // Sweeps over rectangles; one that meets another grows it and is dropped, so the open ones stay few.
    void merge_touching(std::vector<Boxed>& boxes) {
        const float gap = tolerance_;
        for (int round = 0; round < kMergeRounds && boxes.size() > 1; ++round) {
            const std::size_t before = boxes.size();
            std::sort(boxes.begin(), boxes.end(), [](const Boxed& a, const Boxed& b) {
                return a.low.x != b.low.x ? a.low.x < b.low.x : a.region < b.region;
            });
            std::vector<Boxed> done, open;
            for (const Boxed& box : boxes) {
                bool met = false;
                for (std::size_t i = 0; i < open.size() && !met;) {
                    Boxed& other = open[i];
                    if (other.high.x + gap < box.low.x) {
                        done.push_back(other);
                        other = open.back();
                        open.pop_back();
                        continue;
                    }
                    if (other.low.y <= box.high.y + gap && box.low.y <= other.high.y + gap) {
                        merged_[root(box.region)] = root(other.region);
                        other.low = glm::min(other.low, box.low);
                        other.high = glm::max(other.high, box.high);
                        met = true;
                    }
                    ++i;
                }
                if (!met) {
                    open.push_back(box);
                }
            }
            done.insert(done.end(), open.begin(), open.end());
            boxes = std::move(done);
            if (boxes.size() == before) {
                break;
            }
        }
    }

    [[nodiscard]] std::uint32_t root(std::uint32_t r) {
        while (merged_[r] != r) {
            merged_[r] = merged_[merged_[r]];
            r = merged_[r];
        }
        return r;
    }

    // By the length of outline edges over their directions modulo a right angle; exactly along the longest of the winners.
    [[nodiscard]] vec3 main_direction(std::uint32_t r) const {
        const PlanarRegion& region = regions_[r];
        vec3 u, v;
        make_frame(vec3(region.normal), u, v);
        const auto edge = [&](std::uint32_t t, std::uint32_t k) { return corner(t, (k + 1) % 3) - corner(t, k); };
        const vec3 n(region.normal);
        const auto flattened = [&](const vec3& d) {
            const vec3 in_plane = d - n * glm::dot(n, d);
            const float length = glm::length(in_plane);
            return length > 0.0F ? in_plane / length : u;
        };
        if (region.count == 1) {
            const std::uint32_t t = members_[region.first];
            const auto length = [&](std::uint32_t k) { return glm::length(edge(t, k)); };
            const std::uint32_t second = length(1) > length(0) ? 1 : 0;
            return flattened(edge(t, length(2) > length(second) ? 2 : second));
        }
        std::array<float, kDirections> weight{};
        std::array<float, kDirections> longest{};
        std::array<vec3, kDirections> along{};
        for (std::uint32_t i = region.first; i < region.first + region.count && !stop_(); ++i) {
            for (std::uint32_t k = 0; k < 3; ++k) {
                if (inner_edge(3 * members_[i] + k)) {
                    continue;
                }
                const vec3 d = edge(members_[i], k);
                const float length = glm::length(d);
                const float angle = std::atan2(glm::dot(d, v), glm::dot(d, u)) * (2.0F / kPi); // in right angles
                const float turn = (angle - std::floor(angle)) * float(kDirections) + 0.5F;
                const std::size_t bin = std::size_t(turn) % kDirections;
                weight[bin] += length;
                if (length > longest[bin]) {
                    longest[bin] = length;
                    along[bin] = d;
                }
            }
        }
        const auto best = std::size_t(std::max_element(weight.begin(), weight.end()) - weight.begin());
        return flattened(along[best]);
    }

    [[nodiscard]] bool inner_edge(std::uint32_t h) const {
        const std::uint32_t own = region_of_[h / 3];
        std::uint32_t g = rings_[h];
        for (int steps = 0; g != h && steps < kMostOnEdge; g = rings_[g], ++steps) {
            if (region_of_[g / 3] == own) {
                return true;
            }
        }
        return false;
    }

    PlanarRegions collect() {
        // New numbers in the order of the first triangles, members by counting.
        std::vector<std::uint32_t> number(regions_.size(), kNone);
        std::vector<PlanarRegion> out;
        for (std::uint32_t& of : region_of_) {
            if (of == kNone) {
                continue;
            }
            const std::uint32_t old = of;
            const std::uint32_t top = root(old);
            if (number[top] == kNone) {
                number[top] = std::uint32_t(out.size());
                out.emplace_back();
            }
            of = number[top];
            ++out[of].count;
        }
        for (std::uint32_t r = 0; r < regions_.size(); ++r) {
            PlanarRegion& to = out[number[root(r)]];
            to.area += regions_[r].area;
            to.normal += regions_[r].normal * regions_[r].area;
            to.centroid += regions_[r].centroid * regions_[r].area;
        }
        std::uint32_t first = 0;
        for (PlanarRegion& region : out) {
            region.normal = glm::normalize(region.normal);
            region.centroid /= region.area;
            region.first = first;
            first += region.count;
            region.count = 0;
        }
        for (std::uint32_t t = 0; t < region_of_.size(); ++t) {
            if (region_of_[t] != kNone) {
                PlanarRegion& region = out[region_of_[t]];
                members_[region.first + region.count++] = t;
            }
        }
        regions_ = std::move(out);
        for (std::uint32_t r = 0; r < regions_.size() && !stop_(); ++r) {
            regions_[r].axis = main_direction(r);
        }
        return {std::move(regions_), std::move(members_)};
    }

    PlanarSettings settings_;
    const RunContext& context_;
    mutable StopCheck stop_;
    WeldedTriangles mesh_;
    std::vector<std::uint32_t> rings_;
    float tolerance_ = 0.0F;
    std::vector<vec3> normal_; ///< per triangle
    std::vector<float> area_;
    std::vector<std::uint32_t> region_of_;
    std::vector<PlanarRegion> regions_;
    std::vector<std::uint32_t> members_;
    std::vector<std::uint32_t> merged_; ///< union-find over regions_
};

} // namespace

PlanarRegions planar_regions(std::span<const vec3> positions, std::span<const uvec3> triangles,
                             const PlanarSettings& settings, const RunContext& context) {
    return Divider(positions, triangles, settings, context).run();
}

} // namespace atrium
