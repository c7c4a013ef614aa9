#include "ui/viewport/overlay_batch.h"

#include <array>

namespace atrium::ui {
namespace {

constexpr double kSoftEdge = 0.8; ///< logical pixels over which an edge fades

} // namespace

void OverlayBatch::line(const dvec2& a, const dvec2& b, double width, const vec4& color) {
    const dvec2 d = b - a;
    const double length = glm::length(d);
    if (!(length > 1e-6) || !(length < 1e6)) {
        return;
    }
    const dvec2 side = dvec2(-d.y, d.x) / length;
    const double core = std::max(0.5 * width - 0.5 * kSoftEdge, 0.0);
    const double rim = core + kSoftEdge;
    const vec4 clear(color.r, color.g, color.b, 0.0F);
    const std::array<std::pair<double, vec4>, 4> rows{{{-rim, clear}, {-core, color}, {core, color}, {rim, clear}}};
    for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
        const OverlayVertex p{vec2(a + side * rows[i].first), rows[i].second};
        const OverlayVertex q{vec2(b + side * rows[i].first), rows[i].second};
        const OverlayVertex r{vec2(b + side * rows[i + 1].first), rows[i + 1].second};
        const OverlayVertex s{vec2(a + side * rows[i + 1].first), rows[i + 1].second};
        vertices_.insert(vertices_.end(), {p, q, r, p, r, s});
    }
}

void OverlayBatch::triangle(const dvec2& a, const dvec2& b, const dvec2& c, const vec4& color) {
    vertices_.insert(vertices_.end(), {{vec2(a), color}, {vec2(b), color}, {vec2(c), color}});
}

void OverlayBatch::polygon(std::span<const dvec2> convex, const vec4& color) {
    for (std::size_t i = 2; i < convex.size(); ++i) {
        triangle(convex[0], convex[i - 1], convex[i], color);
    }
}

void OverlayBatch::disc(const dvec2& centre, double radius, const vec4& color) {
    constexpr int kSides = 20;
    const vec4 clear(color.r, color.g, color.b, 0.0F);
    for (int i = 0; i < kSides; ++i) {
        const double s = 2.0 * kPiD * i / kSides;
        const double t = 2.0 * kPiD * (i + 1) / kSides;
        const dvec2 u(std::cos(s), std::sin(s));
        const dvec2 v(std::cos(t), std::sin(t));
        triangle(centre, centre + u * radius, centre + v * radius, color);
        const OverlayVertex p{vec2(centre + u * radius), color};
        const OverlayVertex q{vec2(centre + v * radius), color};
        const OverlayVertex r{vec2(centre + v * (radius + kSoftEdge)), clear};
        const OverlayVertex w{vec2(centre + u * (radius + kSoftEdge)), clear};
        vertices_.insert(vertices_.end(), {p, q, r, p, r, w});
    }
}

void OverlayBatch::circle(const dvec2& centre, double radius, double width, const vec4& color) {
    constexpr int kSides = 48;
    for (int i = 0; i < kSides; ++i) {
        const double s = 2.0 * kPiD * i / kSides;
        const double t = 2.0 * kPiD * (i + 1) / kSides;
        line(centre + dvec2(std::cos(s), std::sin(s)) * radius, centre + dvec2(std::cos(t), std::sin(t)) * radius, width,
             color);
    }
}

void OverlayBatch::rectangle(const dvec2& a, const dvec2& b, const vec4& fill, const vec4& border) {
    const std::array<dvec2, 4> corners{{a, {b.x, a.y}, b, {a.x, b.y}}};
    polygon(corners, fill);
    for (std::size_t i = 0; i < 4; ++i) {
        line(corners[i], corners[(i + 1) % 4], 1.0, border);
    }
}

void OverlayBatch::line3(const CameraController& camera, const dvec3& a, const dvec3& b, double width, const vec4& color) {
    const dvec3 ahead = camera.forward();
    const double closest = 0.01;
    double da = glm::dot(a - camera.eye(), ahead);
    double db = glm::dot(b - camera.eye(), ahead);
    if (da < closest && db < closest) {
        return;
    }
    dvec3 p = a;
    dvec3 q = b;
    if (da < closest) {
        p = a + (b - a) * ((closest - da) / (db - da));
    } else if (db < closest) {
        q = b + (a - b) * ((closest - db) / (da - db));
    }
    const auto s = camera.project(p);
    const auto t = camera.project(q);
    if (s && t) {
        line(*s, *t, width, color);
    }
}

void OverlayBatch::arrow(const dvec2& a, const dvec2& b, double width, double head, const vec4& color) {
    const dvec2 d = b - a;
    const double length = glm::length(d);
    if (!(length > 1e-6)) {
        return;
    }
    const dvec2 u = d / length;
    const dvec2 n(-u.y, u.x);
    line(a, b - u * std::min(head, length), width, color);
    triangle(b, b - u * head + n * (0.4 * head), b - u * head - n * (0.4 * head), color);
}

} // namespace atrium::ui
