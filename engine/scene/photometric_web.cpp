#include "engine/scene/photometric_web.h"

#include "engine/base/checks.h"
#include "engine/base/units.h"

#include <algorithm>

namespace atrium {
namespace {

constexpr float kSame = 1e-3F; // degrees: files round their angles

bool same(float a, float b) { return std::abs(a - b) <= kSame; }

std::string number(float value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.6g", double(value));
    return text.data();
}

// Integral of a piecewise linear f between a and b (radians) times sin (polar) or cos.
double weighted(double a, double b, double fa, double fb, bool sine) {
    const double slope = (fb - fa) / (b - a);
    return sine ? fa * std::cos(a) - fb * std::cos(b) + slope * (std::sin(b) - std::sin(a))
                : fb * std::sin(b) - fa * std::sin(a) + slope * (std::cos(b) - std::cos(a));
}

} // namespace

dvec3 photometric_direction(PhotometryType type, double vertical, double horizontal) {
    const double v = radians_from_degrees(vertical);
    const double h = radians_from_degrees(horizontal);
    switch (type) {
    case PhotometryType::C: return {std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)};
    case PhotometryType::B: return {std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v)};
    case PhotometryType::A: return {std::sin(h) * std::cos(v), std::sin(v), -std::cos(h) * std::cos(v)};
    }
    return {0.0, 0.0, -1.0};
}

std::string PhotometricWeb::coverage_fault(const PhotometricData& d) {
    const float v0 = d.vertical.front(), v1 = d.vertical.back();
    const float h0 = d.horizontal.front(), h1 = d.horizontal.back();
    constexpr float kLeast = 0.1F;
    if (!(v1 - v0 >= kLeast)) {
        return "the vertical angles go from " + number(v0) + " to " + number(v1) + ", which is next to nothing";
    }
    if (d.type != PhotometryType::C) {
        if (v0 < -90.0F - kSame || v1 > 90.0F + kSame || (v0 > 0.0F && !same(v0, 0.0F))) {
            return "the vertical angles go from " + number(v0) + " to " + number(v1) +
                   "; of this type they go from -90 or 0 to 90";
        }
        if (d.horizontal.size() < 2 || !(h1 - h0 >= kLeast) || h0 < -90.0F - kSame || h1 > 90.0F + kSame ||
            (h0 > 0.0F && !same(h0, 0.0F))) {
            return "the horizontal angles go from " + number(h0) + " to " + number(h1) +
                   "; of this type they go from -90 or 0 to 90";
        }
        return {};
    }
    if (v0 < -kSame || v1 > 180.0F + kSame) {
        return "the vertical angles go from " + number(v0) + " to " + number(v1) + "; they must lie between 0 and 180";
    }
    if (d.horizontal.size() == 1) {
        return {};
    }
    const bool known = (same(h0, 0.0F) && (same(h1, 90.0F) || same(h1, 180.0F) || (h1 > 180.0F && h1 <= 360.0F + kSame))) ||
                       (same(h0, 90.0F) && same(h1, 270.0F));
    return known ? std::string()
                 : "the horizontal angles go from " + number(h0) + " to " + number(h1) +
                       "; they must go from 0 to 0, 90, 180 or 360, or from 90 to 270";
}

void PhotometricWeb::Axis::prepare() {
    const float range = at.back() - at.front();
    const std::size_t count = std::min<std::size_t>(4 * at.size(), 4096);
    bins_per_degree = float(count) / range;
    bins.resize(count + 1);
    std::size_t i = 0;
    for (std::size_t k = 0; k <= count; ++k) {
        const float from = at.front() + float(k) / bins_per_degree;
        while (i + 2 < at.size() && at[i + 1] <= from) {
            ++i;
        }
        bins[k] = std::uint32_t(i > 0 ? i - 1 : 0); // one earlier: rounding must not skip an interval
    }
}

bool PhotometricWeb::Axis::find(float angle, std::size_t& index, float& t) const {
    // A direction straight down has an angle of exactly 0; one that lies on the border by rounding is not outside.
    if (!(angle >= at.front() - kSame && angle <= at.back() + kSame)) {
        return false;
    }
    const auto bin = std::size_t(std::max((angle - at.front()) * bins_per_degree, 0.0F));
    index = bins[std::min(bin, bins.size() - 1)];
    while (index + 2 < at.size() && angle > at[index + 1]) {
        ++index;
    }
    t = std::clamp((angle - at[index]) / (at[index + 1] - at[index]), 0.0F, 1.0F);
    return true;
}

PhotometricWeb::PhotometricWeb(PhotometricData data) : data_(std::move(data)) {
    ATRIUM_CHECK(data_.vertical.size() >= 2 && !data_.horizontal.empty() &&
                 data_.candela.size() == data_.vertical.size() * data_.horizontal.size() && coverage_fault(data_).empty());
    peak_ = *std::max_element(data_.candela.begin(), data_.candela.end());
    ATRIUM_CHECK(peak_ > 0.0F);
    expand();
    flux_ = integrate();
}

// What the file leaves out as symmetric is put in, so that there is one way to look things up.
void PhotometricWeb::expand() {
    struct Column {
        float angle = 0.0F;
        std::size_t of = 0;   // column of the file
        std::size_t with = 0; // and the one that it is mixed with
        float part = 0.0F;
    };
    std::vector<Column> columns;
    const std::vector<float>& h = data_.horizontal;
    const auto add = [&](auto angle_of, bool reversed) {
        for (std::size_t k = 0; k < h.size(); ++k) {
            const std::size_t i = reversed ? h.size() - 1 - k : k;
            const float angle = angle_of(h[i]);
            if (columns.empty() || angle > columns.back().angle + kSame) {
                columns.push_back({angle, i, i, 0.0F});
            }
        }
    };
    const auto as_is = [](float a) { return a; };
    const bool type_c = data_.type == PhotometryType::C;
    symmetry_ = Symmetry::None;
    if (!type_c) {
        if (same(h.front(), 0.0F)) {
            add([](float a) { return -a; }, true);
        }
        add(as_is, false);
    } else if (h.size() == 1) {
        symmetry_ = Symmetry::Axial;
        columns = {{0.0F}, {360.0F}};
    } else if (same(h.front(), 90.0F)) {
        symmetry_ = Symmetry::About90;
        // From 0 to 90 as from 180 down to 90, from 270 to 360 as from 270 down to 180.
        const auto above = std::size_t(std::lower_bound(h.begin(), h.end(), 180.0F - kSame) - h.begin());
        Column opposite{0.0F, above, above, 0.0F};
        if (!same(h[above], 180.0F)) {
            opposite = {0.0F, above - 1, above, (180.0F - h[above - 1]) / (h[above] - h[above - 1])};
        }
        columns.push_back(opposite);
        for (std::size_t i = above; i-- > 0;) {
            columns.push_back({180.0F - h[i], i, i, 0.0F});
        }
        add(as_is, false);
        for (std::size_t i = h.size() - 1; i-- > 0 && h[i] > 180.0F + kSame;) {
            columns.push_back({540.0F - h[i], i, i, 0.0F});
        }
        opposite.angle = 360.0F;
        columns.push_back(opposite);
    } else if (same(h.back(), 90.0F)) {
        symmetry_ = Symmetry::Quadrants;
        add(as_is, false);
        add([](float a) { return 180.0F - a; }, true);
        add([](float a) { return 180.0F + a; }, false);
        add([](float a) { return 360.0F - a; }, true);
    } else if (same(h.back(), 180.0F)) {
        symmetry_ = Symmetry::About0;
        add(as_is, false);
        add([](float a) { return 360.0F - a; }, true);
    } else {
        add(as_is, false);
        if (columns.back().angle < 360.0F - kSame) {
            columns.push_back({360.0F}); // the last plane, which is the first, is often left out
        }
    }
    // Types A and B: the half below the axis mirrors the half above where the file starts at 0.
    std::vector<std::pair<float, std::size_t>> rows;
    const std::vector<float>& v = data_.vertical;
    if (!type_c && same(v.front(), 0.0F)) {
        for (std::size_t j = v.size(); j-- > 1;) {
            rows.emplace_back(-v[j], j);
        }
    }
    for (std::size_t j = 0; j < v.size(); ++j) {
        rows.emplace_back(v[j], j);
    }
    for (const auto& [angle, j] : rows) {
        vertical_.at.push_back(angle);
    }
    for (const Column& c : columns) {
        horizontal_.at.push_back(c.angle);
        for (const auto& row : rows) {
            const float one = data_.candela[c.of * v.size() + row.second];
            const float other = data_.candela[c.with * v.size() + row.second];
            relative_.push_back((one + c.part * (other - one)) / peak_);
        }
    }
    vertical_.prepare();
    horizontal_.prepare();
}

float PhotometricWeb::relative(const vec3& d) const {
    constexpr float kDegrees = 180.0F / kPi;
    float v = 0.0F, h = 0.0F;
    switch (data_.type) {
    case PhotometryType::C:
        v = kDegrees * std::atan2(std::hypot(d.x, d.y), -d.z);
        if (symmetry_ != Symmetry::Axial) {
            h = kDegrees * std::atan2(d.y, d.x);
            h = h < 0.0F ? h + 360.0F : h;
        }
        break;
    case PhotometryType::B:
        v = kDegrees * std::atan2(d.y, -d.z);
        h = kDegrees * std::atan2(d.x, std::hypot(d.y, d.z));
        break;
    case PhotometryType::A:
        v = kDegrees * std::atan2(d.y, std::hypot(d.x, d.z));
        h = kDegrees * std::atan2(d.x, -d.z);
        break;
    }
    std::size_t j = 0;
    float t = 0.0F;
    if (!vertical_.find(v, j, t)) {
        return 0.0F;
    }
    const std::size_t n = vertical_.at.size();
    if (symmetry_ == Symmetry::Axial) {
        return relative_[j] + t * (relative_[j + 1] - relative_[j]);
    }
    std::size_t i = 0;
    float s = 0.0F;
    if (!horizontal_.find(h, i, s)) {
        return 0.0F;
    }
    const float* a = relative_.data() + i * n + j;
    const float* b = a + n;
    const float low = a[0] + t * (a[1] - a[0]);
    const float high = b[0] + t * (b[1] - b[0]);
    return low + s * (high - low);
}

double PhotometricWeb::integrate() const {
    const std::size_t n = vertical_.at.size();
    const std::size_t m = horizontal_.at.size();
    const auto value = [&](std::size_t i, std::size_t j) { return double(relative_[i * n + j]) * double(peak_); };
    const auto rad = [](float degrees) { return radians_from_degrees(double(degrees)); };
    double sum = 0.0;
    if (data_.type == PhotometryType::B) { // the polar axis is that of the horizontal angle
        for (std::size_t i = 0; i + 1 < m; ++i) {
            const double a = rad(horizontal_.at[i]), b = rad(horizontal_.at[i + 1]);
            for (std::size_t j = 0; j + 1 < n; ++j) {
                const double width = rad(vertical_.at[j + 1]) - rad(vertical_.at[j]);
                sum += width * weighted(a, b, 0.5 * (value(i, j) + value(i, j + 1)),
                                        0.5 * (value(i + 1, j) + value(i + 1, j + 1)), false);
            }
        }
        return sum;
    }
    for (std::size_t i = 0; i + 1 < m; ++i) {
        const double width = rad(horizontal_.at[i + 1]) - rad(horizontal_.at[i]);
        for (std::size_t j = 0; j + 1 < n; ++j) {
            sum += width * weighted(rad(vertical_.at[j]), rad(vertical_.at[j + 1]), 0.5 * (value(i, j) + value(i + 1, j)),
                                    0.5 * (value(i, j + 1) + value(i + 1, j + 1)), data_.type == PhotometryType::C);
        }
    }
    return sum;
}

float PhotometricWeb::tilt_factor(double degrees) const {
    const std::vector<float>& at = data_.tilt;
    if (at.empty()) {
        return 1.0F;
    }
    // Tables up to 90 degrees are for lamps that do not care which end is up.
    const float angle = degrees > 90.0 && at.back() <= 90.0F + kSame ? float(180.0 - degrees) : float(degrees);
    const auto above = std::upper_bound(at.begin(), at.end(), angle);
    if (above == at.begin() || above == at.end()) {
        return above == at.begin() ? data_.tilt_part.front() : data_.tilt_part.back();
    }
    const auto i = std::size_t(above - at.begin());
    const float t = (angle - at[i - 1]) / (at[i] - at[i - 1]);
    return data_.tilt_part[i - 1] + t * (data_.tilt_part[i] - data_.tilt_part[i - 1]);
}

double PhotometricWeb::beam_angle(double plane, double share) const {
    const double h = radians_from_degrees(plane);
    const auto at = [&](double degrees) { // from nadir, negative on the other side
        const double v = radians_from_degrees(degrees);
        return double(relative(vec3(dvec3(std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)))));
    };
    // Lamps that shine upwards are measured about the zenith.
    double down = 0.0, up = 0.0;
    for (int k = 0; k < 180; ++k) {
        (k < 90 ? down : up) = std::max(k < 90 ? down : up, std::max(at(k + 0.5), at(-k - 0.5)));
    }
    const double turn = up > down ? 180.0 : 0.0;
    constexpr int kSteps = 1440;
    const auto outermost = [&](double sign) {
        for (int k = kSteps; k-- > 0;) {
            double in = 180.0 * k / kSteps;
            if (at(turn + sign * in) >= share) {
                double out = 180.0 * (k + 1) / kSteps;
                for (int i = 0; i < 30 && k + 1 < kSteps; ++i) {
                    const double middle = 0.5 * (in + out);
                    (at(turn + sign * middle) >= share ? in : out) = middle;
                }
                return k + 1 < kSteps ? in : 180.0;
            }
        }
        return 0.0;
    };
    return outermost(1.0) + outermost(-1.0);
}

} // namespace atrium
