#include "engine/caustics/resolution.h"

#include <algorithm>

namespace atrium {

int caustic_level(double particles, double epsilon) {
    if (!(particles * epsilon > 0.0)) {
        return 0;
    }
    // Counted up instead of by logarithms: exact at powers of four.
    int level = 0;
    while (level < 15 && 4.0 * std::pow(4.0, level + 1) <= particles * epsilon) {
        ++level;
    }
    return level;
}

TexelCount paper_resolution(int level, const vec2& extent) {
    const double ratio = extent.x > 0.0F && extent.y > 0.0F ? std::log2(double(extent.x) / extent.y) : 0.0;
    const int shift = int(std::lround(0.5 * ratio));
    const auto side = [](int power) { return std::uint32_t(1) << unsigned(std::clamp(power, 0, 14)); };
    return {side(level + shift), side(level - shift)};
}

float footprint_resolution(std::vector<std::pair<float, float>> axis_and_power, double area, std::uint32_t most_texels,
                           float mesh_edge) {
    if (!std::is_sorted(axis_and_power.begin(), axis_and_power.end())) {
        std::sort(axis_and_power.begin(), axis_and_power.end());
    }
    double all = 0.0;
    for (const auto& [axis, power] : axis_and_power) {
        all += power;
    }
    double below = 0.0;
    float median = mesh_edge;
    for (const auto& [axis, power] : axis_and_power) {
        below += power;
        if (below >= 0.2 * all) {
            median = axis;
            break;
        }
    }
    const auto least = float(std::sqrt(area / std::max(double(most_texels), 1.0)));
    return std::max(std::min(0.5F * median, 0.25F * mesh_edge), std::max(least, 1e-5F));
}

} // namespace atrium
