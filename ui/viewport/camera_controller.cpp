#include "ui/viewport/camera_controller.h"

#include "ui/viewport/cutaway.h"

#include <algorithm>
#include <vector>

namespace atrium::ui {
namespace {

constexpr double kMaxPitch = 89.0 * kPiD / 180.0;

/// Share of the picture that a framed box fills in its tighter direction.
constexpr double kFrameFill = 0.85;

double median(std::vector<double>& values) {
    const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double distance_to_box(const DBox3& box, const dvec3& p) {
    return glm::length(glm::max(glm::max(box.min - p, p - box.max), dvec3(0.0)));
}

/// From the front, the right and a little above, as one looks at furniture.
ViewCamera outside_view(const DBox3& bounds) {
    ViewCamera out;
    out.lens.yfov = 0.7F;
    const dvec3 back = glm::normalize(dvec3(0.55, 0.4, 1.0));
    const dvec3 right = glm::normalize(glm::cross(dvec3(0.0, 1.0, 0.0), back));
    const double distance = 0.55 * bounds.diagonal() / std::sin(0.5 * double(out.lens.yfov));
    out.to_world = dmat4(dvec4(right, 0.0), dvec4(glm::cross(back, right), 0.0), dvec4(back, 0.0),
                         dvec4(bounds.centre() + back * distance, 1.0));
    return out;
}

} // namespace

void CameraController::set_viewport(double width, double height) {
    width_ = std::max(width, 1.0);
    height_ = std::max(height, 1.0);
}

dvec3 CameraController::forward() const {
    return {-std::sin(yaw_) * std::cos(pitch_), std::sin(pitch_), -std::cos(yaw_) * std::cos(pitch_)};
}
dvec3 CameraController::right() const { return {std::cos(yaw_), 0.0, -std::sin(yaw_)}; }
dvec3 CameraController::up() const { return glm::cross(right(), forward()); }

ViewCamera CameraController::camera() const {
    ViewCamera out;
    out.to_world = dmat4(dvec4(right(), 0.0), dvec4(up(), 0.0), dvec4(-forward(), 0.0), dvec4(eye_, 1.0));
    out.lens.perspective = true;
    out.lens.yfov = float(yfov_);
    out.lens.znear = float(near_plane());
    out.lens.zfar = float(far_plane());
    return out;
}

void CameraController::set_camera(const ViewCamera& camera) {
    const dvec3 position(camera.to_world[3]);
    dvec3 direction = -dvec3(camera.to_world[2]);
    if (!is_finite(position) || !is_finite(direction) || !(glm::length(direction) > 0.0)) {
        return;
    }
    direction = glm::normalize(direction);
    eye_ = position;
    pitch_ = std::clamp(std::asin(std::clamp(direction.y, -1.0, 1.0)), -kMaxPitch, kMaxPitch);
    if (std::abs(direction.y) < 0.9999) {
        yaw_ = std::atan2(-direction.x, -direction.z);
    } else {
        // Straight down or up: the picture's up tells where the head points.
        const dvec3 head = dvec3(camera.to_world[1]) * (direction.y < 0 ? 1.0 : -1.0);
        yaw_ = std::atan2(-head.x, -head.z);
    }
    focus_distance_ = bounds_.empty() ? 5.0 : std::max(0.3, 0.4 * bounds_.diagonal());
    if (camera.lens.perspective) {
        yfov_ = std::clamp(double(camera.lens.yfov), 0.05, 2.6);
    } else {
        yfov_ = std::clamp(2.0 * std::atan(double(camera.lens.ymag) / focus_distance_), 0.05, 2.6);
    }
}

dmat4 CameraController::rotation() const {
    const dvec3 r = right();
    const dvec3 u = up();
    const dvec3 b = -forward();
    return dmat4(dvec4(r.x, u.x, b.x, 0.0), dvec4(r.y, u.y, b.y, 0.0), dvec4(r.z, u.z, b.z, 0.0), dvec4(0.0, 0.0, 0.0, 1.0));
}

double CameraController::near_plane() const {
    if (bounds_.empty()) {
        return 0.05;
    }
    const double close = std::clamp(bounds_.diagonal() * 0.001, 0.01, 0.05);
    return std::max(close, 0.5 * distance_to_box(bounds_, eye_));
}

double CameraController::far_plane() const {
    double far_distance = 100.0;
    if (!bounds_.empty()) {
        far_distance = 2.0 * (glm::length(eye_ - bounds_.centre()) + bounds_.diagonal());
    }
    return std::max(far_distance, 100.0 * near_plane());
}

dmat4 CameraController::projection() const {
    const double n = near_plane();
    const double f = far_plane();
    const double c = 1.0 / std::tan(0.5 * yfov_);
    dmat4 p(0.0);
    p[0][0] = c * height_ / width_;
    p[1][1] = c;
    p[2][2] = -(f + n) / (f - n);
    p[2][3] = -1.0;
    p[3][2] = -2.0 * f * n / (f - n);
    return p;
}

Ray CameraController::ray(const dvec2& point) const {
    const double t = std::tan(0.5 * yfov_);
    const double x = (2.0 * point.x / width_ - 1.0) * t * width_ / height_;
    const double y = (1.0 - 2.0 * point.y / height_) * t;
    return {eye_, glm::normalize(forward() + right() * x + up() * y)};
}

std::optional<dvec2> CameraController::project(const dvec3& world) const {
    const dvec3 d = world - eye_;
    const double depth = glm::dot(d, forward());
    if (depth <= 1e-6) {
        return std::nullopt;
    }
    const double scale = 0.5 * height_ / (std::tan(0.5 * yfov_) * depth);
    return dvec2(0.5 * width_ + glm::dot(d, right()) * scale, 0.5 * height_ - glm::dot(d, up()) * scale);
}

double CameraController::pixel_size(const dvec3& world) const {
    const double depth = std::max(glm::dot(world - eye_, forward()), near_plane());
    return 2.0 * depth * std::tan(0.5 * yfov_) / height_;
}

void CameraController::turn(double yaw, double pitch) {
    yaw_ = std::remainder(yaw_ + yaw, 2.0 * kPiD);
    pitch_ = std::clamp(pitch_ + pitch, -kMaxPitch, kMaxPitch);
}

void CameraController::orbit(const dvec2& delta, const dvec3& pivot) {
    // The pivot keeps its camera coordinates, so it stays under the cursor.
    const dvec3 d = pivot - eye_;
    const dvec3 seen(glm::dot(d, right()), glm::dot(d, up()), glm::dot(d, forward()));
    turn(-delta.x * kOrbitSpeed, -delta.y * kOrbitSpeed);
    eye_ = pivot - right() * seen.x - up() * seen.y - forward() * seen.z;
    focus_distance_ = std::max(glm::length(d), 0.1);
}

void CameraController::look(const dvec2& delta) {
    const double speed = 1.5 * yfov_ / height_;
    turn(-delta.x * speed, -delta.y * speed);
}

void CameraController::pan(const dvec2& delta, const dvec3& pivot) {
    const double size = pixel_size(pivot);
    eye_ += (-right() * delta.x + up() * delta.y) * size;
}

void CameraController::dolly(double steps, const dvec3& target) {
    const dvec3 d = target - eye_;
    const double distance = glm::length(d);
    if (!(distance > 0.0)) {
        return;
    }
    // A floor of 10 cm a step, so that one never gets stuck in front of a wall: one goes through it.
    const double share = std::pow(0.85, steps);
    double advance = distance * (1.0 - share);
    if (steps > 0 && distance < 0.3) {
        advance = 0.1 * steps;
    }
    eye_ += d * (advance / distance);
    focus_distance_ = std::max(focus_distance_ - advance, 0.3);
}

void CameraController::frame(const DBox3& box) {
    if (box.empty()) {
        return;
    }
    const dvec3 centre = box.centre();
    const double tan_y = std::tan(0.5 * yfov_) * kFrameFill;
    const double tan_x = tan_y * width_ / height_;
    double distance = 0.05;
    for (int i = 0; i < 8; ++i) {
        const dvec3 corner((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                           (i & 4) != 0 ? box.max.z : box.min.z);
        const dvec3 d = corner - centre;
        const double nearer = -glm::dot(d, forward());
        distance = std::max(
            {distance, nearer + std::abs(glm::dot(d, right())) / tan_x, nearer + std::abs(glm::dot(d, up())) / tan_y});
    }
    eye_ = centre - forward() * distance;
    focus_distance_ = distance;
}

void CameraController::walk(const WalkInput& input, double seconds) {
    const dvec3 ahead(-std::sin(yaw_), 0.0, -std::cos(yaw_));
    dvec3 direction = ahead * input.forward + right() * input.right;
    const double length = glm::length(direction);
    if (length > 1.0) {
        direction /= length;
    }
    direction.y += input.up;
    eye_ += direction * (kWalkSpeed * (input.fast ? kFastFactor : 1.0) * seconds);
}

void CameraController::settle_on_floor(double floor_y, double seconds, double eye_height) {
    const double target = floor_y + eye_height;
    const double share = 1.0 - std::exp(-8.0 * seconds);
    eye_.y += (target - eye_.y) * share;
}

DBox3 robust_bounds(const Scene& scene) {
    std::vector<DBox3> boxes;
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        if (node.shape && scene.shown(id)) {
            const DBox3 box = scene.world_bounds(id);
            if (!box.empty() && is_finite(box.min) && is_finite(box.max)) {
                boxes.push_back(box);
            }
        }
    });
    DBox3 out;
    if (boxes.empty()) {
        return out;
    }
    dvec3 centre(0.0);
    std::vector<double> values(boxes.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::transform(boxes.begin(), boxes.end(), values.begin(), [&](const DBox3& b) { return b.centre()[axis]; });
        centre[axis] = median(values);
    }
    const auto reach = [&](const DBox3& b) { return glm::length(b.centre() - centre) + 0.5 * b.diagonal(); };
    std::transform(boxes.begin(), boxes.end(), values.begin(), reach);
    const double limit = 10.0 * median(values);
    for (const DBox3& box : boxes) {
        // What surrounds everything (a ground plane, a sky dome) is left out as well as what lies far away; with few
        // nodes nothing can be told apart.
        if (boxes.size() < 4 || reach(box) <= limit) {
            out.add(box);
        }
    }
    return out;
}

ViewCamera initial_view(const Scene& scene) {
    const DBox3 bounds = robust_bounds(scene);
    for (const NodeId id : scene.in_tree_order()) {
        const Node* node = scene.nodes.find(id);
        const Camera* lens = scene.cameras.find(node->camera);
        if (lens == nullptr) {
            continue;
        }
        ViewCamera view{scene.world_matrix(id), *lens};
        const dvec3 position(view.to_world[3]);
        const dvec3 direction = -dvec3(view.to_world[2]);
        if (!is_finite(position) || !(glm::length(direction) > 0.0)) {
            break;
        }
        // Usable when it looks at the scene from not too far away.
        const double distance = bounds.empty() ? 0.0 : distance_to_box(bounds, position);
        const bool inside = distance <= 0.0;
        const bool faces = bounds.empty() || glm::dot(direction, bounds.centre() - position) > 0.0;
        if (inside || (faces && distance < 3.0 * bounds.diagonal())) {
            return view;
        }
        break;
    }
    if (!bounds.empty() && !is_room(bounds)) {
        return outside_view(bounds);
    }
    return default_camera(scene);
}

} // namespace atrium::ui
