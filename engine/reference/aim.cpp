#include "engine/reference/aim.h"

#include "engine/optics/specular.h"

#include <algorithm>
#include <array>

namespace atrium {
namespace {

constexpr int kLevels = 6;       // at most 64 balls
constexpr double kPieces = 64.0; // into which the whole area is cut at least, where triangles are large
constexpr std::size_t kMostBoxes = 1U << 20U;
constexpr float kWorthwhile = 0.85F; // halves that cover less than this of the whole's outline are better targets

float outline_of(const Box3& box) { return 0.25F * kPi * box.diagonal() * box.diagonal(); }

double area_of(const std::array<vec3, 3>& t) { return 0.5 * double(glm::length(glm::cross(t[1] - t[0], t[2] - t[0]))); }

/// Boxes about quarters of quarters of a triangle, none larger than `most`: two triangles of a large mirror are better aimed
/// at piece by piece.
void add_pieces(const std::array<vec3, 3>& t, double most, std::vector<Box3>& out) {
    if (area_of(t) > most && out.size() < kMostBoxes) {
        const vec3 a = 0.5F * (t[1] + t[2]);
        const vec3 b = 0.5F * (t[2] + t[0]);
        const vec3 c = 0.5F * (t[0] + t[1]);
        add_pieces({t[0], c, b}, most, out);
        add_pieces({c, t[1], a}, most, out);
        add_pieces({b, a, t[2]}, most, out);
        add_pieces({a, b, c}, most, out);
        return;
    }
    Box3 box;
    for (const vec3& p : t) {
        box.add(p);
    }
    out.push_back(box);
}

Box3 around(const std::vector<Box3>& boxes, std::size_t begin, std::size_t end) {
    Box3 out;
    for (std::size_t i = begin; i < end; ++i) {
        out.add(boxes[i]);
    }
    return out;
}

} // namespace

Aim::Aim(const RayScene& rays) {
    std::vector<std::array<vec3, 3>> triangles;
    double area = 0.0;
    for (std::uint32_t s = 0; s < rays.surfaces().size(); ++s) {
        for (std::uint32_t t = 0; is_specular(rays.material(s)) && t < rays.surfaces()[s].triangles.size(); ++t) {
            triangles.push_back(rays.triangle(s, t));
            area += area_of(triangles.back());
        }
    }
    std::vector<Box3> boxes;
    for (const auto& t : triangles) {
        add_pieces(t, area / kPieces, boxes);
    }
    if (boxes.empty()) {
        return;
    }
    divide(boxes, 0, boxes.size(), kLevels);
    for (const Ball& ball : balls_) {
        outline_ += kPi * ball.radius * ball.radius;
    }
    centre_ = rays.bounds().centre();
    reach_ = rays.bounds().diagonal();
}

void Aim::divide(std::vector<Box3>& boxes, std::size_t begin, std::size_t end, int levels) {
    const Box3 whole = around(boxes, begin, end);
    if (levels > 0 && end - begin > 1) {
        const vec3 size = whole.size();
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t middle = begin + (end - begin) / 2;
        const auto at = [&](std::size_t i) { return boxes.begin() + std::ptrdiff_t(i); };
        std::nth_element(at(begin), at(middle), at(end),
                         [axis](const Box3& a, const Box3& b) { return a.centre()[axis] < b.centre()[axis]; });
        const float halves = outline_of(around(boxes, begin, middle)) + outline_of(around(boxes, middle, end));
        if (halves < kWorthwhile * outline_of(whole)) {
            divide(boxes, begin, middle, levels - 1);
            divide(boxes, middle, end, levels - 1);
            return;
        }
    }
    const float rounding = 1e-5F * std::max(glm::length(whole.centre()), 1.0F);
    balls_.push_back({whole.centre(), 0.5F * whole.diagonal() + rounding});
}

float Aim::solid_angle(const Ball& ball, const vec3& from) const {
    const vec3 d = ball.centre - from;
    const float distance2 = glm::dot(d, d);
    const float sine2 = ball.radius * ball.radius / std::max(distance2, 1e-12F);
    return sine2 >= 1.0F ? 4.0F * kPi : 2.0F * kPi * sine2 / (1.0F + std::sqrt(1.0F - sine2));
}

float Aim::solid_angle(const vec3& from) const {
    float sum = 0.0F;
    for (const Ball& ball : balls_) {
        sum += solid_angle(ball, from);
    }
    return sum;
}

Aim::Direction Aim::from_point(const vec3& from, const vec3& u) const {
    Direction out;
    const float whole = solid_angle(from);
    if (!(whole > 0.0F)) {
        return out;
    }
    float left = u.x * whole;
    const Ball* chosen = &balls_.back();
    for (const Ball& ball : balls_) {
        const float own = solid_angle(ball, from);
        if (left < own) {
            chosen = &ball;
            break;
        }
        left -= own;
    }
    const float angle = 2.0F * kPi * u.z;
    const float share = solid_angle(*chosen, from) / (2.0F * kPi); // 1 - cosine of the cone
    const float down = u.y * share;
    const float sine = std::sqrt(std::max(down * (2.0F - down), 0.0F));
    const vec3 d = chosen->centre - from;
    const vec3 axis = share >= 2.0F ? vec3(0.0F, 0.0F, 1.0F) : glm::normalize(d);
    vec3 t;
    vec3 b;
    make_frame(axis, t, b);
    out.direction = glm::normalize((sine * std::cos(angle)) * t + (sine * std::sin(angle)) * b + (1.0F - down) * axis);
    int holding = 0;
    for (const Ball& ball : balls_) {
        const vec3 to = ball.centre - from;
        const vec3 aside = glm::cross(to, out.direction);
        const bool within = glm::dot(to, to) <= ball.radius * ball.radius;
        const bool ahead = glm::dot(aside, aside) <= ball.radius * ball.radius && glm::dot(to, out.direction) > 0.0F;
        holding += &ball == chosen || within || ahead ? 1 : 0;
    }
    out.density = float(holding) / whole;
    return out;
}

Aim::Origin Aim::of_beam(const vec3& direction, const vec3& u) const {
    Origin out;
    if (balls_.empty()) {
        return out;
    }
    float left = u.x * outline_;
    const Ball* chosen = &balls_.back();
    for (const Ball& ball : balls_) {
        const float own = kPi * ball.radius * ball.radius;
        if (left < own) {
            chosen = &ball;
            break;
        }
        left -= own;
    }
    vec3 t;
    vec3 b;
    make_frame(direction, t, b);
    const float r = chosen->radius * std::sqrt(u.y);
    const float angle = 2.0F * kPi * u.z;
    const vec3 p = chosen->centre + (r * std::cos(angle)) * t + (r * std::sin(angle)) * b;
    int holding = 0;
    for (const Ball& ball : balls_) {
        const vec3 aside = glm::cross(ball.centre - p, direction);
        holding += &ball == chosen || glm::dot(aside, aside) <= ball.radius * ball.radius ? 1 : 0;
    }
    out.origin = p - direction * (glm::dot(p - centre_, direction) + reach_);
    out.density = float(holding) / outline_;
    return out;
}

} // namespace atrium
