// Particles where they landed, as points over the picture.
#include "ui/viewport/gpu_scene.h"

#include <algorithm>

namespace atrium::ui {

void GpuScene::forget_landings() {
    for (auto& [key, names] : points_) {
        gl_->glDeleteVertexArrays(1, &names.first);
        gl_->glDeleteBuffers(1, &names.second);
    }
    points_.clear();
    landings_.reset();
}

void GpuScene::draw_landings(const ViewScene& view, const DrawView& from,
                             const std::shared_ptr<const std::vector<SurfaceLandings>>& landings,
                             const std::unordered_set<NodeId>& of, float pixel_ratio) {
    if (landings != landings_) {
        forget_landings();
        landings_ = landings;
    }
    if (!landings_) {
        return;
    }
    Gl& gl = *gl_;
    gl.glEnable(GL_DEPTH_TEST);
    gl.glDepthMask(GL_FALSE);
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    gl.glPointSize(1.5F * pixel_ratio);
    mask_->bind();
    mask_->setUniformValue("u_color", QVector4D(1.0F, 0.2F, 0.05F, 0.5F));
    const int place = mask_->uniformLocation("u_mvp");
    const dmat4 view_projection = from.projection * from.rotation;
    for (const SurfaceLandings& side : *landings_) {
        if (!of.contains(side.node) || side.places.empty()) {
            continue;
        }
        const auto item = std::find_if(view.items().begin(), view.items().end(),
                                       [&](const ViewItem& one) { return one.node == side.node && one.part == side.part; });
        if (item == view.items().end() || from.cutaway.part_of(item->bounds) == Cutaway::Part::All) {
            continue;
        }
        auto& [array, buffer] = points_[&side];
        if (array == 0) {
            gl.glGenVertexArrays(1, &array);
            gl.glGenBuffers(1, &buffer);
            gl.glBindVertexArray(array);
            gl.glBindBuffer(GL_ARRAY_BUFFER, buffer);
            gl.glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(side.places.size() * sizeof(vec3)), side.places.data(),
                            GL_STATIC_DRAW);
            gl.glEnableVertexAttribArray(0);
            gl.glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(vec3), nullptr);
        }
        dmat4 model = item->world;
        model[3] -= dvec4(from.eye, 0.0);
        dmat4 clip = view_projection * model;
        // A little towards the eye, or half of them would be lost in their surface.
        for (int column = 0; column < 4; ++column) {
            clip[column][2] -= 2e-4 * clip[column][3];
        }
        const mat4 mvp(clip);
        gl.glUniformMatrix4fv(place, 1, GL_FALSE, &mvp[0][0]);
        gl.glBindVertexArray(array);
        gl.glDrawArrays(GL_POINTS, 0, GLsizei(side.places.size()));
    }
    gl.glBindVertexArray(0);
    mask_->release();
    gl.glDisable(GL_BLEND);
    gl.glDepthMask(GL_TRUE);
}

} // namespace atrium::ui
