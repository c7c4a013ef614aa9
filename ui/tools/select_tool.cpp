#include "ui/tools/select_tool.h"

#include <algorithm>

namespace atrium::ui {
namespace {

bool extends(Qt::KeyboardModifiers modifiers) { return (modifiers & (Qt::ControlModifier | Qt::ShiftModifier)) != 0; }

} // namespace

void SelectTool::press(const Pointer& pointer) {
    state_ = State::Pressed;
    start_ = end_ = pointer.position;
}

void SelectTool::move(const Pointer& pointer) {
    end_ = pointer.position;
    if (state_ == State::Pressed && glm::length(end_ - start_) > kClickRadius) {
        state_ = State::Box;
    }
}

void SelectTool::release(const Pointer& pointer) {
    end_ = pointer.position;
    if (state_ == State::Box) {
        select_box(extends(pointer.modifiers));
    } else if (state_ == State::Pressed) {
        click({start_, pointer.modifiers});
    }
    state_ = State::Idle;
}

void SelectTool::click(const Pointer& pointer) {
    Selection* selection = host_.document().selection();
    const auto hit = host_.pick(pointer.position);
    if (hit && extends(pointer.modifiers)) {
        selection->toggle(hit->node);
    } else if (hit) {
        selection->set({hit->node});
    } else if (!extends(pointer.modifiers)) {
        selection->clear();
    }
}

void SelectTool::select_box(bool extend) {
    const Scene& scene = host_.document().scene();
    const dvec2 low = glm::min(start_, end_);
    const dvec2 high = glm::max(start_, end_);
    std::vector<NodeId> found;
    if (extend) {
        found = host_.document().selection()->nodes();
    }
    for (const NodeId id : scene.in_tree_order()) {
        const Node* node = scene.nodes.find(id);
        if ((!node->shape && !node->light && !node->camera) || !scene.shown(id)) {
            continue;
        }
        DBox3 box = scene.world_bounds(id);
        if (box.empty()) {
            box.add(dvec3(scene.world_matrix(id)[3]));
        }
        bool inside = true;
        for (int corner = 0; corner < 8 && inside; ++corner) {
            const dvec3 p((corner & 1) != 0 ? box.max.x : box.min.x, (corner & 2) != 0 ? box.max.y : box.min.y,
                          (corner & 4) != 0 ? box.max.z : box.min.z);
            const auto s = host_.camera().project(p);
            inside = s && s->x >= low.x && s->x <= high.x && s->y >= low.y && s->y <= high.y;
        }
        if (inside && std::find(found.begin(), found.end(), id) == found.end()) {
            found.push_back(id);
        }
    }
    host_.document().selection()->set(std::move(found));
}

void SelectTool::draw(OverlayBatch& batch) const {
    if (state_ == State::Box) {
        batch.rectangle(start_, end_, vec4(0.3F, 0.6F, 1.0F, 0.12F), vec4(0.3F, 0.6F, 1.0F, 0.9F));
    }
}

} // namespace atrium::ui
