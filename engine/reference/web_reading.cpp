#include "engine/reference/web_reading.h"

#include "engine/base/units.h"

#include <algorithm>
#include <optional>

namespace atrium {
namespace {

struct Between {
    std::size_t low = 0;
    double part = 0.0; // of the one after it
};

std::optional<Between> between(const std::vector<float>& angles, double angle) {
    if (angles.size() == 1) {
        return Between{};
    }
    constexpr double kRounding = 1e-3; // degrees; files round their angles
    if (angle < double(angles.front()) - kRounding || angle > double(angles.back()) + kRounding) {
        return std::nullopt;
    }
    std::size_t i = 0;
    while (i + 2 < angles.size() && double(angles[i + 1]) <= angle) {
        ++i;
    }
    const double low = angles[i], high = angles[i + 1];
    return Between{i, std::clamp((angle - low) / (high - low), 0.0, 1.0)};
}

// The horizontal angle as the file has it: what it leaves out is a mirror image of what it holds.
double measured_angle(const std::vector<float>& h, double angle) {
    const double last = h.back();
    if (h.front() > 45.0F) { // 90 to 270
        return angle < 90.0 ? 180.0 - angle : (angle > 270.0 ? 540.0 - angle : angle);
    }
    if (last < 180.0 + 0.01) {
        angle = std::min(angle, 360.0 - angle);
    }
    return last < 90.0 + 0.01 ? std::min(angle, 180.0 - angle) : angle;
}

} // namespace

double read_candela(const PhotometricData& data, const dvec3& d) {
    double v = 0.0, h = 0.0;
    if (data.type == PhotometryType::C) {
        v = degrees_from_radians(std::acos(std::clamp(-d.z, -1.0, 1.0)));
        h = degrees_from_radians(std::atan2(d.y, d.x));
        h = data.horizontal.size() > 1 ? measured_angle(data.horizontal, h < 0.0 ? h + 360.0 : h) : 0.0;
    } else {
        const bool a = data.type == PhotometryType::A;
        v = degrees_from_radians(a ? std::asin(std::clamp(d.y, -1.0, 1.0)) : std::atan2(d.y, -d.z));
        h = degrees_from_radians(a ? std::atan2(d.x, -d.z) : std::asin(std::clamp(d.x, -1.0, 1.0)));
        v = data.vertical.front() > -0.01F ? std::abs(v) : v;
        h = data.horizontal.front() > -0.01F ? std::abs(h) : h;
    }
    // The plane that closes the circle may be missing: then it is the first one.
    const std::vector<float>& planes = data.horizontal;
    const bool open = planes.size() > 1 && data.type == PhotometryType::C && h > double(planes.back()) + 1e-3;
    const auto row = between(data.vertical, v);
    const auto column =
        open ? std::optional(Between{planes.size() - 1, (h - planes.back()) / (360.0 - planes.back())}) : between(planes, h);
    if (!row || !column) {
        return 0.0;
    }
    const std::size_t n = data.vertical.size();
    const auto at = [&](std::size_t i) {
        const float* plane = data.candela.data() + (i < planes.size() ? i : 0) * n + row->low;
        return double(plane[0]) * (1.0 - row->part) + double(plane[1]) * row->part;
    };
    return column->part > 0.0 ? at(column->low) * (1.0 - column->part) + at(column->low + 1) * column->part
                              : at(column->low);
}

} // namespace atrium
