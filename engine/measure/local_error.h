// How far off the light is likely to be at a place, from an audit's places that are like it.
#pragma once

#include "engine/measure/error_audit.h"

#include <cstdint>
#include <vector>

namespace atrium {

/// Errors are large in corners and shade and small in the open: one number for a scene is too much for most of it. This
/// takes those places of an audit that are most like the one in question: near, turned the same way, as bright. Immutable;
/// any thread.
class LocalError {
public:
    /// How many places an estimate is made of.
    static constexpr std::size_t kPlaces = 32;

    explicit LocalError(std::vector<AuditPlace> places);
    [[nodiscard]] bool empty() const { return places_.empty(); }
    [[nodiscard]] std::size_t size() const { return places_.size(); }

    /// Root mean square of the relative error, to be read as a standard deviation; 0 without places. What few places happen
    /// to say is drawn towards what all say. `left_out`: a place that is not to be asked.
    [[nodiscard]] double at(const dvec3& point, const dvec3& normal, double illuminance,
                            std::size_t left_out = SIZE_MAX) const;
    /// Of all places.
    [[nodiscard]] double overall() const { return overall_; }
    [[nodiscard]] const std::vector<AuditPlace>& places() const { return places_; }

private:
    std::vector<AuditPlace> places_;
    double length_ = 1.0; ///< metres that count as far
    double dark_ = 0.0;   ///< lux: no place is darker than that
    double overall_ = 0.0;
};

} // namespace atrium
