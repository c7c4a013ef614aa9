// FLIP after Andersson, Nilsson, Akenine-Moller, Oskarsson, Astrom, Fairchild, "FLIP: A Difference Evaluator for Alternating
// Images", 2020; the numbers below are the paper's.
#include "engine/base/checks.h"
#include "engine/base/parallel.h"
#include "engine/base/units.h"
#include "engine/measure/compare.h"

#include <algorithm>
#include <cmath>

namespace atrium {

namespace {

using Plane = std::vector<float>;

/// Colours as three planes.
struct Planes {
    int width = 0;
    int height = 0;
    Plane c[3];
    explicit Planes(int w, int h) : width(w), height(h) {
        for (Plane& plane : c) {
            plane.resize(std::size_t(w) * std::size_t(h));
        }
    }
};

constexpr float kWhite[3] = {0.950428545F, 1.0F, 1.088900371F}; // D65

vec3 xyz_from_linear(const vec3& c) {
    return {0.41238656F * c.r + 0.35759149F * c.g + 0.18045049F * c.b,
            0.21263682F * c.r + 0.71518298F * c.g + 0.0721802F * c.b,
            0.01933062F * c.r + 0.11919716F * c.g + 0.95037259F * c.b};
}

vec3 linear_from_xyz(const vec3& c) {
    return {3.24100326F * c.x - 1.53739899F * c.y - 0.49861587F * c.z,
            -0.96922426F * c.x + 1.87592999F * c.y + 0.04155422F * c.z,
            0.05563942F * c.x - 0.2040112F * c.y + 1.05714897F * c.z};
}

/// Opponent space of the contrast sensitivity filters.
vec3 ycxcz(const vec3& linear) {
    const vec3 c = xyz_from_linear(linear);
    const float x = c.x / kWhite[0];
    const float y = c.y / kWhite[1];
    const float z = c.z / kWhite[2];
    return {116.0F * y - 16.0F, 500.0F * (x - y), 200.0F * (y - z)};
}

vec3 linear_from_ycxcz(const vec3& c) {
    const float y = (c.x + 16.0F) / 116.0F;
    return linear_from_xyz({(c.y / 500.0F + y) * kWhite[0], y * kWhite[1], (y - c.z / 200.0F) * kWhite[2]});
}

/// CIELAB with the chroma scaled by lightness (Hunt effect).
vec3 hunt_lab(const vec3& linear) {
    const vec3 c = xyz_from_linear(linear);
    float f[3];
    for (int k = 0; k < 3; ++k) {
        const float t = c[k] / kWhite[k];
        constexpr float kDelta = 6.0F / 29.0F;
        f[k] = t > kDelta * kDelta * kDelta ? std::cbrt(t) : t / (3.0F * kDelta * kDelta) + 4.0F / 29.0F;
    }
    const float lightness = 116.0F * f[1] - 16.0F;
    return {lightness, 0.01F * lightness * 500.0F * (f[0] - f[1]), 0.01F * lightness * 200.0F * (f[1] - f[2])};
}

float hyab(const vec3& a, const vec3& b) { return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z); }

/// One-dimensional weights from -radius to radius.
using Weights = std::vector<float>;

Plane convolve(const Plane& in, int width, int height, const Weights& along_x, const Weights& along_y) {
    Plane half(in.size());
    Plane out(in.size());
    const int radius = int(along_x.size() / 2);
    parallel_chunks(std::size_t(height), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t y = begin; y < end; ++y) {
            const float* row = in.data() + y * std::size_t(width);
            for (int x = 0; x < width; ++x) {
                float sum = 0;
                for (int k = -radius; k <= radius; ++k) {
                    sum += along_x[std::size_t(k + radius)] * row[std::clamp(x + k, 0, width - 1)];
                }
                half[y * std::size_t(width) + std::size_t(x)] = sum;
            }
        }
    });
    parallel_chunks(std::size_t(height), 8, [&](std::size_t begin, std::size_t end, std::size_t) {
        for (std::size_t y = begin; y < end; ++y) {
            float* row = out.data() + y * std::size_t(width);
            for (int k = -radius; k <= radius; ++k) {
                const auto from = std::size_t(std::clamp(int(y) + k, 0, height - 1)) * std::size_t(width);
                const float weight = along_y[std::size_t(k + radius)];
                for (int x = 0; x < width; ++x) {
                    row[x] += weight * half[from + std::size_t(x)];
                }
            }
        }
    });
    return out;
}

/// Contrast sensitivity of one channel as one or two Gaussians a * sqrt(pi / b) * exp(-pi^2 x^2 / b), x in degrees.
Plane sensitivity_filter(const Plane& in, int width, int height, std::span<const std::pair<double, double>> terms,
                         double ppd) {
    const int radius = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPiD * kPiD)) * ppd));
    Plane out(in.size());
    double total = 0;
    for (const auto& [a, b] : terms) {
        Weights weights;
        double sum = 0;
        for (int k = -radius; k <= radius; ++k) {
            const double x = k / ppd;
            weights.push_back(float(std::exp(-kPiD * kPiD * x * x / b)));
            sum += double(weights.back());
        }
        const double share = a * std::sqrt(kPiD / b);
        total += share * sum * sum;
        const Plane part = convolve(in, width, height, weights, weights);
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i] += float(share) * part[i];
        }
    }
    for (float& v : out) {
        v = float(double(v) / total);
    }
    return out;
}

Planes opponent_planes(const Picture& picture) {
    Planes out(picture.width, picture.height);
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        const vec3 c = ycxcz(glm::clamp(picture.pixels[i], vec3(0.0F), vec3(1.0F)));
        for (int k = 0; k < 3; ++k) {
            out.c[k][i] = c[k];
        }
    }
    return out;
}

/// What an observer at the given distance sees of the colours, ready for the colour difference.
std::vector<vec3> seen_colors(const Planes& planes, double ppd) {
    constexpr std::pair<double, double> kAchromatic[] = {{1.0, 0.0047}};
    constexpr std::pair<double, double> kRedGreen[] = {{1.0, 0.0053}};
    constexpr std::pair<double, double> kBlueYellow[] = {{34.1, 0.04}, {13.5, 0.025}};
    const std::span<const std::pair<double, double>> terms[3] = {kAchromatic, kRedGreen, kBlueYellow};
    std::vector<vec3> out(planes.c[0].size());
    for (int k = 0; k < 3; ++k) {
        const Plane filtered = sensitivity_filter(planes.c[k], planes.width, planes.height, terms[k], ppd);
        for (std::size_t i = 0; i < out.size(); ++i) {
            out[i][k] = filtered[i];
        }
    }
    for (vec3& c : out) {
        c = hunt_lab(glm::clamp(linear_from_ycxcz(c), vec3(0.0F), vec3(1.0F)));
    }
    return out;
}

/// Strength of edges (order 1) or points (order 2) in the achromatic channel.
Plane features(const Planes& planes, int order, double ppd) {
    Plane lightness(planes.c[0].size());
    for (std::size_t i = 0; i < lightness.size(); ++i) {
        lightness[i] = (planes.c[0][i] + 16.0F) / 116.0F;
    }
    const double sigma = 0.5 * 0.082 * ppd;
    const int radius = int(std::ceil(3.0 * sigma));
    Weights smooth;
    std::vector<double> slope;
    double sum = 0;
    double positive = 0;
    double negative = 0;
    for (int k = -radius; k <= radius; ++k) {
        const double g = std::exp(-k * k / (2.0 * sigma * sigma));
        smooth.push_back(float(g));
        sum += g;
        slope.push_back(order == 1 ? -k * g : (k * k / (sigma * sigma) - 1.0) * g);
        (slope.back() > 0 ? positive : negative) += std::abs(slope.back());
    }
    Weights change;
    for (const double s : slope) { // positive and negative weights each add up to one
        change.push_back(float(s / (s > 0 ? positive : negative)));
    }
    for (float& v : smooth) {
        v = float(double(v) / sum);
    }
    const Plane x = convolve(lightness, planes.width, planes.height, change, smooth);
    Plane y = convolve(lightness, planes.width, planes.height, smooth, change);
    for (std::size_t i = 0; i < y.size(); ++i) {
        y[i] = std::hypot(x[i], y[i]);
    }
    return y;
}

} // namespace

double flip(const Picture& test, const Picture& reference, double ppd) {
    ATRIUM_CHECK(test.width == reference.width && test.height == reference.height);
    if (test.pixels.empty()) {
        return 0.0;
    }
    const Planes planes[2] = {opponent_planes(test), opponent_planes(reference)};
    const std::vector<vec3> colors[2] = {seen_colors(planes[0], ppd), seen_colors(planes[1], ppd)};
    const Plane edges[2] = {features(planes[0], 1, ppd), features(planes[1], 1, ppd)};
    const Plane points[2] = {features(planes[0], 2, ppd), features(planes[1], 2, ppd)};

    constexpr float kColorExponent = 0.7F;
    constexpr float kKnee = 0.4F;
    constexpr float kKneeValue = 0.95F;
    const float most = std::pow(hyab(hunt_lab({0.0F, 1.0F, 0.0F}), hunt_lab({0.0F, 0.0F, 1.0F})), kColorExponent);
    const float knee = kKnee * most;
    double sum = 0;
    for (std::size_t i = 0; i < test.pixels.size(); ++i) {
        const float power = std::pow(hyab(colors[0][i], colors[1][i]), kColorExponent);
        const float color =
            power < knee ? power * kKneeValue / knee : kKneeValue + (power - knee) / (most - knee) * (1.0F - kKneeValue);
        const float change = std::max(std::abs(edges[0][i] - edges[1][i]), std::abs(points[0][i] - points[1][i]));
        const float feature = std::sqrt(change * 0.70710678F);
        sum += double(std::pow(std::min(color, 1.0F), 1.0F - std::min(feature, 1.0F)));
    }
    return sum / double(test.pixels.size());
}

} // namespace atrium
