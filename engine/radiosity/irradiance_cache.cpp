#include "engine/radiosity/irradiance_cache.h"

#include "engine/base/parallel.h"
#include "engine/base/rng.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace atrium {
namespace {

using Cell = glm::vec<3, std::int32_t>;
constexpr std::uint32_t kNone = 0xFFFFFFFFU;
constexpr std::size_t kGrain = 4;
constexpr float kWithinReach =
    0.45F; // weight of a record that a point needs at least: records overlap, so that gradients are known
constexpr int kMostRounds = 4; // of looking where interpolation is off

Cell cell_of(const vec3& p, float size) {
    return {std::int32_t(std::floor(p.x / size)), std::int32_t(std::floor(p.y / size)),
            std::int32_t(std::floor(p.z / size))};
}

// A share of no light is none, or without bound.
float share(float part, float whole) {
    if (whole > 0.0F) {
        return part / whole;
    }
    return part > 0.0F ? std::numeric_limits<float>::infinity() : 0.0F;
}

} // namespace

IrradianceCache::IrradianceCache(const RayScene& rays, Sampler sampler, const CacheSettings& settings)
    : rays_(rays), sampler_(std::move(sampler)), settings_(settings) {
    levels_ = 1 + level_of(settings_.largest_reach);
}

int IrradianceCache::level_of(float reach) const {
    return std::max(0, int(std::ceil(std::log2(std::max(reach / settings_.smallest_reach, 1.0F)))));
}

std::uint64_t IrradianceCache::cell_key(int level, const Cell& c) {
    return hash_combine(hash_combine(std::uint64_t(std::uint32_t(c.x)) << 32 | std::uint32_t(c.y), std::uint32_t(c.z)),
                        std::uint64_t(level));
}

// Half the longest reach of a level's records: what is looked at around a point is little more than what reaches it.
float IrradianceCache::cell_size(int level) const { return 0.5F * settings_.smallest_reach * std::exp2(float(level)); }

void IrradianceCache::insert(std::uint32_t index, Cells& cells) const {
    const Place& record = places_[index];
    const int level = level_of(record.reach);
    const float size = cell_size(level), reach2 = record.reach * record.reach * 1.0001F;
    const Cell low = cell_of(record.position - vec3(record.reach), size);
    const Cell high = cell_of(record.position + vec3(record.reach), size);
    for (int z = low.z; z <= high.z; ++z) {
        for (int y = low.y; y <= high.y; ++y) {
            for (int x = low.x; x <= high.x; ++x) {
                const vec3 corner = vec3(float(x), float(y), float(z)) * size;
                const vec3 off = record.position - glm::clamp(record.position, corner, corner + size);
                if (glm::dot(off, off) <= reach2) {
                    cells[cell_key(level, {x, y, z})].push_back(index);
                }
            }
        }
    }
}

float IrradianceCache::weight(const Place& r, const vec3& point, const vec3& normal) const {
    const vec3 d = point - r.position;
    const float distance2 = glm::dot(d, d);
    const float cosine = glm::dot(normal, r.normal);
    if (distance2 >= r.reach * r.reach || cosine <= settings_.normal_cosine) {
        return 0.0F;
    }
    // Points well before or behind the record's plane see something else.
    const float height = std::abs(glm::dot(d, normal + r.normal)) * 0.5F;
    const float far = std::max(std::sqrt(distance2), 4.0F * height) / r.reach;
    const float bent = std::sqrt(std::max(1.0F - cosine, 0.0F) / (1.0F - settings_.normal_cosine));
    return std::max(1.0F - std::max(far, bent), 0.0F);
}

// Lifted off both surfaces by more than the bulge of a round one between them.
bool IrradianceCache::sees(const Place& r, const vec3& point, const vec3& normal) const {
    const float distance = glm::length(point - r.position);
    const float lift = 0.08F * distance + 1e-3F * settings_.smallest_reach;
    return distance < 1e-3F * settings_.smallest_reach ||
           !rays_.occluded(r.position + r.normal * lift, point + normal * lift);
}

template <typename Take> void IrradianceCache::each_near(const Cells& cells, const vec3& point, Take&& take) const {
    for (int level = 0; level < levels_; ++level) {
        const auto it = cells.find(cell_key(level, cell_of(point, cell_size(level))));
        if (it == cells.end()) {
            continue;
        }
        for (const std::uint32_t index : it->second) {
            if (!take(index)) {
                return;
            }
        }
    }
}

bool IrradianceCache::reached(const vec3& point, const vec3& normal) const {
    bool found = false;
    each_near(cells_, point, [&](std::uint32_t index) {
        const Place& record = places_[index];
        found = weight(record, point, normal) > kWithinReach && sees(record, point, normal);
        return !found;
    });
    return found;
}

std::size_t IrradianceCache::find(const vec3& point, const vec3& normal, std::uint32_t skip,
                                  std::array<Use, kMostUsed>& out) const {
    thread_local std::vector<Use> heap; // the heaviest on top, of equal ones the first that was met
    heap.clear();
    each_near(cells_, point, [&](std::uint32_t index) {
        const float heavy = index != skip ? weight(places_[index], point, normal) : 0.0F;
        if (heavy > 0.0F) {
            heap.push_back({index, heavy});
        }
        return true;
    });
    const auto lighter = [](const Use& a, const Use& b) {
        return a.weight != b.weight ? a.weight < b.weight : a.record > b.record;
    };
    std::make_heap(heap.begin(), heap.end(), lighter);
    std::size_t count = 0;
    while (count < kMostUsed && !heap.empty()) {
        std::pop_heap(heap.begin(), heap.end(), lighter);
        if (sees(places_[heap.back().record], point, normal)) {
            out[count++] = heap.back();
        }
        heap.pop_back();
    }
    return count;
}

Rgb IrradianceCache::predict(std::uint32_t record, const vec3& point) const {
    const Record& r = records_[record];
    const vec3 d = point - places_[record].position;
    const float u = glm::dot(d, r.tangent);
    const float v = glm::dot(d, glm::cross(places_[record].normal, r.tangent));
    return glm::max(r.irradiance + r.gradient[0] * u + r.gradient[1] * v, Rgb(0.0F));
}

FieldSample IrradianceCache::at(const vec3& point, const vec3& normal) const {
    std::array<Use, kMostUsed> used;
    const std::size_t count = find(point, normal, kNone, used);
    if (count == 0) {
        return sampler_(point, normal);
    }
    FieldSample out;
    float sum = 0.0F;
    for (std::size_t i = 0; i < count; ++i) {
        const Record& r = records_[used[i].record];
        out.irradiance += predict(used[i].record, point) * used[i].weight;
        // Neighbouring records use the same directions: their errors are alike and do not average out.
        out.variance += r.variance * used[i].weight;
        out.distance += places_[used[i].record].reach / settings_.spacing * used[i].weight;
        sum += used[i].weight;
    }
    out.irradiance /= sum;
    out.variance /= sum;
    out.distance /= sum;
    return out;
}

// One round: of the points out of reach, some that are `separation` apart get records. `open` shrinks to what is left.
bool IrradianceCache::add_round(std::span<const SurfacePoint> points, std::vector<std::uint32_t>& open, float separation,
                                const RunContext& context) {
    std::vector<std::uint8_t> is_reached(open.size(), 0);
    parallel_chunks(open.size(), 256, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            const SurfacePoint& p = points[open[i]];
            is_reached[i] = reached(p.position, p.normal) ? 1 : 0;
        }
    });
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> taken;
    std::vector<std::uint32_t> left;
    std::vector<std::uint32_t> chosen;
    const float room2 = separation * separation;
    StopCheck stop(context, kMeshStride);
    for (std::size_t i = 0; i < open.size() && !stop(); ++i) {
        if (is_reached[i] != 0) {
            continue;
        }
        left.push_back(open[i]);
        const SurfacePoint& p = points[open[i]];
        const Cell cell = cell_of(p.position, separation);
        bool free = true;
        for (int k = 0; k < 27 && free; ++k) {
            const Cell near = cell + Cell(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1);
            const auto it = taken.find(cell_key(0, near));
            free = it == taken.end() || std::none_of(it->second.begin(), it->second.end(), [&](std::uint32_t j) {
                       const vec3 d = points[j].position - p.position;
                       return glm::dot(d, d) < room2 && glm::dot(points[j].normal, p.normal) > settings_.normal_cosine;
                   });
        }
        if (free) {
            taken[cell_key(0, cell)].push_back(open[i]);
            chosen.push_back(open[i]);
        }
    }
    if (records_.size() + chosen.size() > settings_.max_records) {
        chosen.resize(settings_.max_records - std::min(settings_.max_records, records_.size()));
    }
    std::vector<FieldSample> samples(chosen.size());
    parallel_chunks(chosen.size(), kGrain, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = begin; i < end && !context.should_stop(); ++i) {
            samples[i] = sampler_(points[chosen[i]].position, points[chosen[i]].normal);
        }
    });
    if (context.should_stop()) {
        return false;
    }
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const SurfacePoint& p = points[chosen[i]];
        Record r;
        r.irradiance = samples[i].irradiance;
        r.variance = samples[i].variance;
        Place place{p.position, 0.0F, p.normal};
        place.reach =
            std::clamp(std::min(settings_.spacing * samples[i].distance, settings_.to_nearest * samples[i].nearest),
                       settings_.smallest_reach, settings_.largest_reach);
        vec3 b;
        make_frame(p.normal, r.tangent, b);
        records_.push_back(r);
        places_.push_back(place);
        insert(std::uint32_t(records_.size() - 1), cells_);
    }
    open = std::move(left);
    return true;
}

bool IrradianceCache::cover_reach(std::span<const SurfacePoint> points, std::vector<std::uint32_t> open,
                                  const RunContext& context) {
    // Wide steps first: where much is far away few records do, and what they leave is filled by closer ones.
    for (float separation = settings_.largest_reach; !open.empty() && records_.size() < settings_.max_records;
         separation *= 0.5F) {
        const std::size_t before = records_.size();
        if (!add_round(points, open, std::max(separation, 0.5F * settings_.smallest_reach), context)) {
            return false;
        }
        if (separation < 0.5F * settings_.smallest_reach && records_.size() == before) {
            break; // what is left cannot see its own record: points inside solids
        }
    }
    return true;
}

void IrradianceCache::fit_gradients(std::size_t first, const RunContext& context) {
    error_.resize(records_.size(), -1.0F);
    std::vector<std::array<Rgb, 2>> gradient(records_.size());
    const std::size_t count_new = records_.size() - first;
    struct Neighbours {
        std::size_t count = 0;
        std::array<Use, kMostUsed> used;
    };
    std::vector<Neighbours> neighbours(count_new);
    parallel_chunks(count_new, 128, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = first + begin; i < first + end && !context.should_stop(); ++i) {
            const Record& r = records_[i];
            const Place& at = places_[i];
            gradient[i] = {Rgb(0.0F), Rgb(0.0F)};
            auto& [count, used] = neighbours[i - first];
            count = find(at.position, at.normal, std::uint32_t(i), used);
            if (count < 3) {
                continue;
            }
            const vec3 bitangent = glm::cross(at.normal, r.tangent);
            double uu = 0.0, uv = 0.0, vv = 0.0;
            Rgb ue(0.0F), ve(0.0F);
            for (std::size_t k = 0; k < count; ++k) {
                const Record& other = records_[used[k].record];
                const vec3 d = places_[used[k].record].position - at.position;
                const float u = glm::dot(d, r.tangent), v = glm::dot(d, bitangent), w = used[k].weight;
                uu += double(w) * u * u;
                uv += double(w) * u * v;
                vv += double(w) * v * v;
                ue += (other.irradiance - r.irradiance) * (w * u);
                ve += (other.irradiance - r.irradiance) * (w * v);
            }
            // A little damping: neighbours on one line say nothing about the other direction.
            const double damping = 0.05 * (uu + vv);
            uu += damping;
            vv += damping;
            const auto det = float(uu * vv - uv * uv);
            if (det > 0.0F) {
                gradient[i] = {(ue * float(vv) - ve * float(uv)) / det, (ve * float(uu) - ue * float(uv)) / det};
            }
        }
    });
    for (std::size_t i = first; i < records_.size(); ++i) {
        records_[i].gradient = gradient[i];
    }
    parallel_chunks(count_new, 128, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t i = first + begin; i < first + end && !context.should_stop(); ++i) {
            const Record& r = records_[i];
            const auto& [count, used] = neighbours[i - first];
            Rgb sum(0.0F);
            float weights = 0.0F;
            for (std::size_t k = 0; k < count; ++k) {
                sum += predict(used[k].record, places_[i].position) * used[k].weight;
                weights += used[k].weight;
            }
            if (weights > 0.0F) {
                const float own = luminance(r.irradiance);
                error_[i] = share(std::abs(luminance(sum) / weights - own), std::max(own, settings_.light_floor));
            }
        }
    });
}

IrradianceCache::Cells IrradianceCache::shorten() {
    Cells before;
    for (std::uint32_t i = 0; i < records_.size(); ++i) {
        float& reach = places_[i].reach;
        // Between records the error is smaller than at one that is left out: about half. What chance explains is none.
        const float noise = share(3.0F * std::sqrt(records_[i].variance),
                                  std::max(luminance(records_[i].irradiance), settings_.light_floor));
        if (error_[i] > std::max(2.0F * settings_.contrast, noise) && reach > settings_.smallest_reach) {
            insert(i, before);
            reach = std::max(0.6F * reach, settings_.smallest_reach); // its cells hold it still, and some more around
        }
    }
    return before;
}

bool IrradianceCache::cover(std::span<const SurfacePoint> points, const RunContext& context) {
    std::vector<std::uint32_t> open(points.size()); // those that may be out of reach
    std::iota(open.begin(), open.end(), 0U);
    for (int round = 0; round < kMostRounds; ++round) {
        const std::size_t before = records_.size();
        if (!cover_reach(points, std::move(open), context)) {
            return false;
        }
        if (records_.size() == before) {
            break; // nothing new to judge
        }
        // A few more records change little for those that are there.
        const bool many = records_.size() - before > records_.size() / 20;
        fit_gradients(many ? 0 : before, context);
        if (context.should_stop()) {
            return false;
        }
        const Cells shortened = shorten();
        if (shortened.empty()) {
            break;
        }
        open.clear();
        for (std::uint32_t i = 0; i < points.size(); ++i) {
            bool near = false;
            each_near(shortened, points[i].position, [&](std::uint32_t) {
                near = true;
                return false;
            });
            if (near) {
                open.push_back(i);
            }
        }
    }
    return true;
}

} // namespace atrium
