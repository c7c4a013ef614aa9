#include "engine/radiosity/sky_window.h"

#include "engine/geometry/form_factor.h"

#include <algorithm>
#include <optional>

namespace atrium {
namespace {

// Steradians: smaller ones lose digits to cancellation, and by area they are even enough.
constexpr double kLeastAngle = 0.02;

// The rectangle that two triangles with a common edge make; none where they make none.
std::optional<SkyWindow> joined(const std::array<vec3, 3>& a, const std::array<vec3, 3>& b) {
    const float size = glm::length(a[1] - a[0]) + glm::length(a[2] - a[1]);
    const auto same = [size](const vec3& p, const vec3& q) { return glm::length(p - q) <= 1e-4F * size; };
    for (std::size_t i = 0; i < 3; ++i) {
        const vec3& apex = a[i];
        const vec3& next = a[(i + 1) % 3];
        const vec3& last = a[(i + 2) % 3];
        for (std::size_t j = 0; j < 3; ++j) {
            const vec3& across = b[j];
            const bool shared = (same(b[(j + 1) % 3], last) && same(b[(j + 2) % 3], next)) ||
                                (same(b[(j + 1) % 3], next) && same(b[(j + 2) % 3], last));
            const bool right = std::abs(glm::dot(next - apex, last - apex)) <= 1e-4F * size * size;
            if (shared && right && same(next + last - apex, across)) {
                SkyWindow w;
                w.corners = {apex, next, across, last};
                w.normal = glm::normalize(glm::cross(next - apex, last - apex));
                return w;
            }
        }
    }
    return std::nullopt;
}

float sample_linear(float u, float a, float b) {
    const float sum = a + std::sqrt((1.0F - u) * a * a + u * b * b);
    return sum > 0.0F ? std::min(u * (a + b) / sum, 1.0F) : u;
}

} // namespace

float SkyWindow::form_factor(const vec3& point, const vec3& from_normal) const {
    if (opening && glm::dot(normal, corners[0] - point) <= 0.0F) {
        return 0.0F;
    }
    return float(form_factor_to_polygon(point, from_normal, outline()));
}

float SkyWindow::crossing(const vec3& point, const vec3& direction) const {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    const float slope = glm::dot(normal, direction);
    const float t = glm::dot(normal, corners[0] - point) / slope;
    if (slope == 0.0F || !(t > 0.0F) || (opening && slope < 0.0F)) {
        return kNone;
    }
    const vec3 at = point + t * direction - corners[0];
    if (corner_count == 4) {
        const vec3 u = corners[1] - corners[0], v = corners[3] - corners[0];
        const float x = glm::dot(at, u), y = glm::dot(at, v);
        return x >= 0.0F && y >= 0.0F && x <= glm::dot(u, u) && y <= glm::dot(v, v) ? t : kNone;
    }
    for (unsigned i = 0; i < 3; ++i) {
        const vec3 edge = corners[(i + 1) % 3] - corners[i];
        if (glm::dot(glm::cross(edge, at + corners[0] - corners[i]), normal) < 0.0F) {
            return kNone;
        }
    }
    return t;
}

std::vector<SkyWindow> pane_windows(const RayScene& rays) {
    std::vector<SkyWindow> out;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        if (!rays.surfaces()[s].pane) {
            continue;
        }
        std::vector<std::array<vec3, 3>> alone; // the few triangles of one pane that still look for a partner
        for (std::uint32_t t = 0; t < rays.surfaces()[s].triangles.size(); ++t) {
            const auto triangle = rays.triangle(s, t);
            bool found = false;
            for (std::size_t i = 0; i < alone.size() && !found; ++i) {
                if (const auto rectangle = joined(alone[i], triangle)) {
                    out.push_back(*rectangle);
                    alone.erase(alone.begin() + std::ptrdiff_t(i));
                    found = true;
                }
            }
            if (!found) {
                alone.push_back(triangle);
            }
        }
        for (const auto& p : alone) {
            SkyWindow w;
            w.corners = {p[0], p[1], p[2], p[2]};
            w.corner_count = 3;
            w.normal = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
            out.push_back(w);
        }
    }
    return out;
}

WindowPoints::WindowPoints(const SkyWindow& window, const vec3& point, const vec3& normal)
    : window_(window), point_(point), normal_(normal) {
    if (window.corner_count != 4) {
        return;
    }
    const dvec3 from = dvec3(window.corners[0]) - dvec3(point);
    const dvec3 u = dvec3(window.corners[1]) - dvec3(window.corners[0]);
    const dvec3 v = dvec3(window.corners[3]) - dvec3(window.corners[0]);
    const double lu = glm::length(u), lv = glm::length(v);
    const dvec3 x = u / lu, y = v / lv;
    dvec3 z = glm::cross(x, y);
    if (glm::dot(from, z) > 0.0) {
        z = -z;
    }
    const double z0 = glm::dot(from, z), x0 = glm::dot(from, x), x1 = x0 + lu, y0 = glm::dot(from, y), y1 = y0 + lv;
    // The planes through the receiver and the four edges, and the angles between them: in double, they nearly cancel.
    const auto plane = [](const dvec3& a, const dvec3& b) { return glm::normalize(glm::cross(a, b)); };
    const dvec3 c00(x0, y0, z0), c10(x1, y0, z0), c11(x1, y1, z0), c01(x0, y1, z0);
    const dvec3 n0 = plane(c00, c10), n1 = plane(c10, c11), n2 = plane(c11, c01), n3 = plane(c01, c00);
    const auto between = [](const dvec3& a, const dvec3& b) { return std::acos(std::clamp(-glm::dot(a, b), -1.0, 1.0)); };
    const double k = 2.0 * kPiD - between(n2, n3) - between(n3, n0);
    const double angle = between(n0, n1) + between(n1, n2) - k;
    by_angle_ = angle > kLeastAngle;
    if (!by_angle_) {
        return;
    }
    x_ = vec3(x);
    y_ = vec3(y);
    z_ = vec3(z);
    x0_ = float(x0);
    x1_ = float(x1);
    y0_ = float(y0);
    y1_ = float(y1);
    z0_ = float(z0);
    b0_ = float(n0.z);
    b1_ = float(n2.z);
    k_ = float(k);
    angle_ = float(angle);
    const std::array<dvec3, 4> corners{c00, c10, c01, c11};
    for (std::size_t i = 0; i < 4; ++i) {
        const dvec3 d = glm::normalize(x * corners[i].x + y * corners[i].y + z * corners[i].z);
        // Not to nothing: where the horizon cuts the window, the corners do not tell what is between them.
        cosine_[i] = float(std::max(glm::dot(d, dvec3(normal)), 0.05));
    }
}

// From the unit square to the rectangle by solid angle, relative to the receiver.
vec3 WindowPoints::on_rectangle(float u, float v) const {
    const float au = u * angle_ + k_;
    const float fu = (std::cos(au) * b0_ - b1_) / std::sin(au);
    const float cu = std::clamp(std::copysign(1.0F, fu) / std::sqrt(fu * fu + b0_ * b0_), -1.0F, 1.0F);
    const float x = std::clamp(-(cu * z0_) / std::max(std::sqrt(1.0F - cu * cu), 1e-6F), x0_, x1_);
    const float d2 = x * x + z0_ * z0_;
    const float h0 = y0_ / std::sqrt(d2 + y0_ * y0_), h1 = y1_ / std::sqrt(d2 + y1_ * y1_);
    const float h = h0 + v * (h1 - h0);
    const float y = h * h < 1.0F - 1e-6F ? std::clamp(h * std::sqrt(d2) / std::sqrt(1.0F - h * h), y0_, y1_) : y1_;
    return x_ * x + y_ * y + z_ * z0_;
}

WindowPoints::Place WindowPoints::at(const vec2& u) const {
    Place out;
    vec3 d;
    float density = 1.0F;
    if (by_angle_) {
        const float y = sample_linear(u.y, cosine_[0] + cosine_[1], cosine_[2] + cosine_[3]);
        const float low = cosine_[0] + y * (cosine_[2] - cosine_[0]), high = cosine_[1] + y * (cosine_[3] - cosine_[1]);
        const float x = sample_linear(u.x, low, high);
        density = low + x * (high - low);
        d = on_rectangle(x, y);
    } else if (window_.corner_count == 4) {
        d = window_.corners[0] + (window_.corners[1] - window_.corners[0]) * u.x +
            (window_.corners[3] - window_.corners[0]) * u.y - point_;
    } else {
        const float a = std::sqrt(u.x);
        d = window_.corners[0] * (1.0F - a) + window_.corners[1] * (a * (1.0F - u.y)) + window_.corners[2] * (a * u.y) -
            point_;
    }
    const float distance2 = glm::dot(d, d);
    const float cosine = glm::dot(d, normal_);
    if (!(distance2 > 0.0F) || !(cosine > 0.0F)) {
        return out;
    }
    out.distance = std::sqrt(distance2);
    out.direction = d / out.distance;
    out.weight = by_angle_ ? cosine / (out.distance * density)
                           : cosine * std::abs(glm::dot(d, window_.normal)) / (distance2 * distance2);
    return out;
}

} // namespace atrium
