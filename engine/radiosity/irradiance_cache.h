// Smooth light sampled where it changes: records of irradiance on surfaces, interpolated with gradients (Ward, Rubinstein &
// Clear 1988; gradients by least squares over neighbouring records).
#pragma once

#include "engine/base/run_context.h"
#include "engine/radiosity/hierarchy.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

namespace atrium {

/// Irradiance at a point with what interpolation needs to know about it.
struct FieldSample {
    Rgb irradiance{0.0F};
    float variance = 0.0F; ///< of luminance(irradiance), lux^2
    float distance = 0.0F; ///< harmonic mean distance of what is seen, metres; infinite where nothing is
    float nearest = 0.0F;  ///< distance of the nearest of what is seen (but for a few rays in a hundred), metres
};

/// How densely records lie. Lengths in metres.
struct CacheSettings {
    float spacing = 0.35F;   ///< reach of a record as a share of the mean distance of what it sees
    float to_nearest = 0.9F; ///< the same of the nearest that it sees: light changes quickly at the foot of things
    float smallest_reach = 0.04F;
    float largest_reach = 0.8F;
    float normal_cosine = 0.94F; ///< records whose normal differs more are not used (cosine of about 20 degrees)
    float contrast = 0.05F;      ///< relative error of the interpolation that asks for more records
    float light_floor = 1.0F;    ///< lux: errors are judged against at least this irradiance
    std::size_t max_records = 400'000;
};

/// Records are made by cover() (engine thread; parallel inside, the same for any number of threads) and read by at() from
/// any thread. Nothing reaches through walls: a record is used only where it can be seen.
class IrradianceCache {
public:
    using Sampler = std::function<FieldSample(const vec3& point, const vec3& normal)>;
    IrradianceCache(const RayScene& rays, Sampler sampler, const CacheSettings& settings);

    /// Makes records until every point is within reach of one, then more where interpolation is off. False when stopped.
    bool cover(std::span<const SurfacePoint> points, const RunContext& context);
    /// Interpolated irradiance with the variance of its records; sampled on the spot where no record is near.
    [[nodiscard]] FieldSample at(const vec3& point, const vec3& normal) const;
    [[nodiscard]] std::size_t size() const { return records_.size(); }

private:
    /// Where a record holds: all that a search reads.
    struct Place {
        vec3 position;
        float reach;
        vec3 normal;
    };
    struct Record {
        Rgb irradiance;
        float variance;
        vec3 tangent;                                      ///< with normal x tangent spans the plane of the gradient
        std::array<Rgb, 2> gradient{Rgb(0.0F), Rgb(0.0F)}; ///< per metre along tangent and normal x tangent
    };
    struct Use {
        std::uint32_t record;
        float weight;
    };
    using Cells = std::unordered_map<std::uint64_t, std::vector<std::uint32_t>>;
    static constexpr std::size_t kMostUsed = 12;

    [[nodiscard]] float weight(const Place& r, const vec3& point, const vec3& normal) const;
    [[nodiscard]] bool sees(const Place& r, const vec3& point, const vec3& normal) const;
    /// Calls `take` with the records in whose cells a point lies until it returns false.
    template <typename Take> void each_near(const Cells& cells, const vec3& point, Take&& take) const;
    /// Some record reaches a point and can be seen from it.
    [[nodiscard]] bool reached(const vec3& point, const vec3& normal) const;
    /// The heaviest kMostUsed of the records that reach a point and can be seen from it, the heaviest first; `skip` is left
    /// out. Returns their number.
    std::size_t find(const vec3& point, const vec3& normal, std::uint32_t skip, std::array<Use, kMostUsed>& out) const;
    [[nodiscard]] Rgb predict(std::uint32_t record, const vec3& point) const;
    /// Into all cells that the record reaches.
    void insert(std::uint32_t record, Cells& cells) const;
    bool add_round(std::span<const SurfacePoint> points, std::vector<std::uint32_t>& open, float separation,
                   const RunContext& context);
    /// Makes records until each of the `open` points is within reach of one.
    bool cover_reach(std::span<const SurfacePoint> points, std::vector<std::uint32_t> open, const RunContext& context);
    /// Gradients and errors of the records from `first` on.
    void fit_gradients(std::size_t first, const RunContext& context);
    /// Shortens the reach of records that their neighbours do not predict; where these reached before.
    Cells shorten();
    [[nodiscard]] int level_of(float reach) const;
    [[nodiscard]] float cell_size(int level) const;
    [[nodiscard]] static std::uint64_t cell_key(int level, const glm::vec<3, std::int32_t>& cell);

    const RayScene& rays_;
    Sampler sampler_;
    CacheSettings settings_;
    std::vector<Record> records_;
    std::vector<Place> places_; ///< of the records
    std::vector<float> error_;  ///< per record, relative, of the interpolation from its neighbours; negative = not known
    int levels_ = 1;
    Cells cells_;
};

} // namespace atrium
