#include "engine/measure/local_error.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace atrium {
namespace {

constexpr double kFar = 0.15;  ///< of the extent of all places: as unlike as a right angle, or as e times the light
constexpr double kPrior = 8.0; ///< places' worth of the whole scene's error in every estimate
constexpr double kDark = 0.05; ///< of the mean

} // namespace

LocalError::LocalError(std::vector<AuditPlace> places) : places_(std::move(places)) {
    DBox3 bounds;
    double light = 0.0, squares = 0.0;
    for (const AuditPlace& p : places_) {
        bounds.add(p.point);
        light += p.computed;
        squares += p.square;
    }
    if (places_.empty()) {
        return;
    }
    const auto count = double(places_.size());
    length_ = std::max(kFar * glm::length(bounds.max - bounds.min), 1e-6);
    dark_ = std::max(kDark * light / count, 1e-9);
    overall_ = std::sqrt(std::max(squares / count, 0.0));
}

double LocalError::at(const dvec3& point, const dvec3& normal, double illuminance, std::size_t left_out) const {
    if (places_.empty()) {
        return 0.0;
    }
    const double light = std::log(std::max(illuminance, dark_));
    std::array<std::pair<double, double>, kPlaces> nearest; // how unlike, square; a heap with the most unlike on top
    std::size_t count = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
        if (i == left_out) {
            continue;
        }
        const AuditPlace& p = places_[i];
        const dvec3 d = (p.point - point) / length_;
        const double l = std::log(std::max(p.computed, dark_)) - light;
        const double unlike = glm::dot(d, d) + 1.0 - glm::dot(p.normal, normal) + l * l;
        if (count < kPlaces) {
            nearest[count++] = {unlike, p.square};
            std::push_heap(nearest.begin(), nearest.begin() + std::ptrdiff_t(count));
        } else if (unlike < nearest[0].first) {
            std::pop_heap(nearest.begin(), nearest.end());
            nearest.back() = {unlike, p.square};
            std::push_heap(nearest.begin(), nearest.end());
        }
    }
    double sum = kPrior * overall_ * overall_;
    for (std::size_t i = 0; i < count; ++i) {
        sum += nearest[i].second;
    }
    return std::sqrt(std::max(sum, 0.0) / (double(count) + kPrior));
}

} // namespace atrium
