#include "engine/radiosity/gather_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace atrium {
namespace {

constexpr float kPrecision = 1e-4F; // of angles, by which cones and balls are held to be wider than they come out

bool shines(const Element& e) { return e.power > 0.0F; }

// Where only one branch below shines, that branch.
std::uint32_t shining(const Hierarchy& h, std::uint32_t element) {
    for (;;) {
        const Element& e = h.elements[element];
        std::uint32_t only = Element::kNone, count = 0;
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            if (shines(h.elements[e.first_child + k])) {
                only = e.first_child + k;
                ++count;
            }
        }
        if (count != 1) {
            return element;
        }
        element = only;
    }
}

struct NormalCone {
    vec3 axis{0.0F};
    float angle = 0.0F; // half of it, radians
};

// Of directions with room for each one's own cone.
template <class Visit> NormalCone cone_about(const vec3& sum, const Visit& visit) {
    NormalCone out;
    const float length = glm::length(sum);
    if (!(length > 1e-6F)) {
        out.axis = vec3(0.0F, 0.0F, 1.0F);
        out.angle = kPi;
        return out;
    }
    out.axis = sum / length;
    visit([&](const vec3& axis, float angle) {
        const float between = std::acos(std::clamp(glm::dot(axis, out.axis), -1.0F, 1.0F));
        out.angle = std::min(std::max(out.angle, between + angle + kPrecision), kPi);
    });
    return out;
}

void set_cone(GatherNode& node, const NormalCone& cone) {
    node.axis = cone.axis;
    node.cosine = std::cos(cone.angle);
    node.sine = std::max(std::sin(cone.angle), 0.0F);
}

NormalCone cone_of_leaf(const Hierarchy& h, const Element& e) {
    if (e.kind == Element::Kind::Patch) {
        return {e.normal, kPrecision};
    }
    const std::span<const Face> faces = std::span(h.faces).subspan(e.triangle, e.face_count);
    vec3 sum(0.0F);
    for (const Face& f : faces) {
        sum += f.area * f.normal;
    }
    return cone_about(sum, [&](const auto& add) {
        for (const Face& f : faces) {
            add(f.normal, 0.0F);
        }
    });
}

} // namespace

bool GatherNode::turns_away_from(const vec3& point) const {
    const vec3 d = point - centre;
    const float r2 = glm::dot(d, d), out2 = r2 - radius * radius;
    if (!(out2 > 0.0F) || cosine <= 0.0F) {
        return false;
    }
    // The widest angle between a normal and the way to the point is that between the axis and the middle, the cone's, and
    // the ball's; all of it must be beyond a right angle.
    const float r = std::sqrt(r2), ball_sine = radius / r, ball_cosine = std::sqrt(out2) / r;
    const float both_cosine = cosine * ball_cosine - sine * ball_sine, both_sine = sine * ball_cosine + cosine * ball_sine;
    return both_cosine > 0.0F && glm::dot(axis, d) <= -(both_sine + kPrecision) * r;
}

bool GatherNode::may_be_near(const vec3& point, float radii) const {
    const vec3 d = point - centre;
    // The ball holds all of the leaf: its middle lies by its radius deeper.
    const float reach = 1.0001F * radius + std::max(radii - 1.0F, 0.0F) * largest;
    return glm::dot(d, d) < reach * reach;
}

GatherTree::GatherTree(const Hierarchy& h) {
    if (h.empty() || !shines(h.elements[0])) {
        return;
    }
    nodes_.emplace_back();
    nodes_.back().element = shining(h, 0);
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Element& e = h.elements[nodes_[i].element];
        nodes_[i].first_child = std::uint32_t(nodes_.size());
        for (std::uint32_t k = 0; k < e.child_count; ++k) {
            if (shines(h.elements[e.first_child + k])) {
                GatherNode child;
                child.element = shining(h, e.first_child + k);
                nodes_.push_back(child);
                ++nodes_[i].child_count;
            }
        }
    }
    std::vector<NormalCone> cones(nodes_.size());
    std::vector<Box3> bounds(nodes_.size()); // of the balls of leaves
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        GatherNode& node = nodes_[i];
        const Element& e = h.elements[node.element];
        if (node.child_count == 0) {
            node.centre = e.centre;
            node.radius = node.largest = e.radius;
            bounds[i] = {e.centre - vec3(e.radius), e.centre + vec3(e.radius)};
            cones[i] = cone_of_leaf(h, e);
            set_cone(node, cones[i]);
            continue;
        }
        vec3 sum(0.0F);
        for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
            bounds[i].add(bounds[k]);
            sum += h.elements[nodes_[k].element].area * cones[k].axis;
            node.largest = std::max(node.largest, nodes_[k].largest);
        }
        node.centre = bounds[i].centre();
        for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
            node.radius = std::max(node.radius, glm::length(nodes_[k].centre - node.centre) + nodes_[k].radius);
        }
        node.radius = std::min(node.radius, 0.5F * bounds[i].diagonal());
        cones[i] = cone_about(sum, [&](const auto& add) {
            for (std::uint32_t k = node.first_child; k < node.first_child + node.child_count; ++k) {
                add(cones[k].axis, cones[k].angle);
            }
        });
        set_cone(node, cones[i]);
    }
}

} // namespace atrium
