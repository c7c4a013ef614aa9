#include "engine/view/look_through.h"

namespace atrium {
namespace {

/// Right, up and back of a camera, unit and at right angles; those of its parent's space where the placement has none (a
/// scale of zero, or axes that fall together).
std::array<vec3, 3> camera_axes(const dmat4& to_world) {
    dvec3 back(to_world[2]);
    dvec3 up(to_world[1]);
    const auto usable = [](const dvec3& v) { return std::isfinite(glm::dot(v, v)) && glm::dot(v, v) > 0.0; };
    back = usable(back) ? glm::normalize(back) : dvec3(0.0, 0.0, 1.0);
    up = usable(up) ? glm::normalize(up) : dvec3(0.0, 1.0, 0.0);
    dvec3 right(to_world[0]);
    // A shear is kept as it is; only what gives no picture at all is replaced.
    right = usable(right) ? glm::normalize(right) : glm::cross(up, back);
    if (std::abs(glm::dot(right, glm::cross(up, back))) < 1e-9) {
        up = std::abs(back.y) < 0.9 ? dvec3(0.0, 1.0, 0.0) : dvec3(0.0, 0.0, -1.0);
        right = glm::normalize(glm::cross(up, back));
        up = glm::cross(back, right);
    }
    return {vec3(right), vec3(up), vec3(back)};
}

} // namespace

CameraRays::CameraRays(const ViewCamera& camera, const dvec3& origin, int width, int height)
    : eye_(dvec3(camera.to_world[3]) - origin), aspect_(float(width) / float(height)),
      half_height_(camera.lens.perspective ? std::tan(0.5F * camera.lens.yfov) : camera.lens.ymag), width_(float(width)),
      height_(float(height)), perspective_(camera.lens.perspective) {
    const auto axes = camera_axes(camera.to_world);
    right_ = axes[0];
    up_ = axes[1];
    forward_ = -axes[2];
}

Ray CameraRays::through(float x, float y) const {
    const float sx = (2.0F * x / width_ - 1.0F) * half_height_ * aspect_;
    const float sy = (1.0F - 2.0F * y / height_) * half_height_;
    if (perspective_) {
        return {eye_, glm::normalize(forward_ + sx * right_ + sy * up_)};
    }
    return {eye_ + sx * right_ + sy * up_, forward_};
}

float CameraRays::depth_of(const vec3& point) const {
    return glm::dot(right_, glm::cross(up_, point - eye_)) / glm::dot(right_, glm::cross(up_, forward_));
}

std::optional<vec2> CameraRays::pixel_of(const vec3& point) const {
    // A sheared camera's axes are not at right angles: solve for what of each leads to the point.
    const vec3 d = point - eye_;
    const float volume = glm::dot(right_, glm::cross(up_, forward_));
    const float x = glm::dot(d, glm::cross(up_, forward_)) / volume;
    const float y = glm::dot(right_, glm::cross(d, forward_)) / volume;
    const float z = glm::dot(right_, glm::cross(up_, d)) / volume;
    if (perspective_ && !(z > kNearest)) {
        return std::nullopt;
    }
    const vec2 s = vec2(x, y) / (perspective_ ? z : 1.0F) / half_height_;
    return vec2(0.5F * (s.x / aspect_ + 1.0F) * width_, 0.5F * (1.0F - s.y) * height_);
}

} // namespace atrium
