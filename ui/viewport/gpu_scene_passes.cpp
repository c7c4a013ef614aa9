// What GpuScene draws beside the picture itself: silhouettes, edges, and the room in flat mirrors.
#include "ui/viewport/gpu_scene_parts.h"

namespace atrium::ui {
namespace {

/// The part of the view that a box can cover.
vec4 window_of(const Box3& box, const mat4& mvp) {
    vec4 window(1.0F, 1.0F, -1.0F, -1.0F);
    for (int i = 0; i < 8; ++i) {
        const vec4 p = mvp * vec4((i & 1) != 0 ? box.max.x : box.min.x, (i & 2) != 0 ? box.max.y : box.min.y,
                                  (i & 4) != 0 ? box.max.z : box.min.z, 1.0F);
        if (p.w < 1e-4F) {
            return vec4(-1.0F, -1.0F, 1.0F, 1.0F);
        }
        window.x = std::min(window.x, p.x / p.w);
        window.y = std::min(window.y, p.y / p.w);
        window.z = std::max(window.z, p.x / p.w);
        window.w = std::max(window.w, p.y / p.w);
    }
    return glm::clamp(window, vec4(-1.0F), vec4(1.0F));
}

} // namespace

void GpuScene::draw_flat(const ViewItem& item, const mat4& mvp, const vec4& color) {
    mask_->bind();
    mask_->setUniformValue("u_color", QVector4D(color.r, color.g, color.b, color.a));
    gl_->glUniformMatrix4fv(mask_->uniformLocation("u_mvp"), 1, GL_FALSE, &mvp[0][0]);
    set_sides(item, false);
    const Geometry& geometry = geometry_of(item);
    bind(item, geometry, lighting_of(item));
    gl_->glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    mask_->release();
}

void GpuScene::draw_mirror(const ViewItem& item, const ViewScene& view, const Scene& scene, const DrawView& from,
                           const mat4& mvp, int stencil) {
    const Geometry& geometry = geometry_of(item);
    const dvec3 point(item.world * dvec4(dvec3(item.mesh->positions[item.mesh->indices[0]]), 1.0));
    dvec3 normal = glm::normalize(glm::transpose(glm::inverse(dmat3(item.world))) * dvec3(geometry.normal));
    const double height = glm::dot(from.eye - point, normal);
    if (height < 0.0) {
        if (!item.material->double_sided) {
            return;
        }
        normal = -normal;
    }
    Gl& gl = *gl_;
    const vec4 background(from.background, 1.0F);
    // Where the mirror is seen ...
    gl.glEnable(GL_STENCIL_TEST);
    gl.glStencilFunc(GL_ALWAYS, stencil, 0xFF);
    gl.glStencilOp(GL_KEEP, GL_KEEP, GL_REPLACE);
    gl.glDepthFunc(GL_LEQUAL);
    gl.glEnable(GL_POLYGON_OFFSET_FILL); // another program need not give the very same depth
    gl.glPolygonOffset(-1.0F, -1.0F);
    draw_flat(item, mvp, background);
    gl.glDisable(GL_POLYGON_OFFSET_FILL);
    // ... nothing is near any more ...
    gl.glStencilFunc(GL_EQUAL, stencil, 0xFF);
    gl.glStencilOp(GL_KEEP, GL_KEEP, GL_KEEP);
    gl.glDepthFunc(GL_ALWAYS);
    gl.glDepthRange(1.0, 1.0);
    draw_flat(item, mvp, background);
    gl.glDepthRange(0.0, 1.0);
    gl.glDepthFunc(GL_LESS);
    // ... so that the room shows, seen from behind the mirror ...
    DrawView behind = from;
    behind.reflected = true;
    behind.cutaway = {}; // a mirror shows the walls
    const dmat3 reflection = dmat3(1.0) - 2.0 * glm::outerProduct(normal, normal);
    behind.rotation = from.rotation * dmat4(reflection);
    behind.eye = from.eye - normal * (2.0 * glm::dot(from.eye - point, normal));
    // A millimetre in front, so that the mirror does not hide what it shows.
    behind.clip = vec4(vec3(normal), float(glm::dot(behind.eye - point, normal) - 0.001));
    behind.window = window_of(item.bvh->bounds(), mvp);
    behind.filter = glm::clamp(item.material->base_color, Rgb(0.0F), Rgb(1.0F));
    gl.glEnable(GL_CLIP_DISTANCE0);
    draw(view, scene, behind);
    gl.glDisable(GL_CLIP_DISTANCE0);
    // ... and later things are in front of the mirror or behind it as before.
    gl.glDepthFunc(GL_ALWAYS);
    gl.glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    gl.glEnable(GL_DEPTH_TEST);
    draw_flat(item, mvp, background);
    gl.glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.glDepthFunc(GL_LESS);
    gl.glDisable(GL_STENCIL_TEST);
}

void GpuScene::draw_mask(const ViewScene& view, const DrawView& from, const vec4& color,
                         const std::function<bool(const ViewItem&)>& wanted) {
    mask_->bind();
    mask_->setUniformValue("u_color", QVector4D(color.r, color.g, color.b, color.a));
    const int place = mask_->uniformLocation("u_mvp");
    const dmat4 view_projection = from.projection * from.rotation;
    for (const ViewItem& item : view.items()) {
        if (!wanted(item)) {
            continue;
        }
        const mat4 mvp(view_projection * relative_to_eye(item, from.eye));
        if (out_of_sight(item.bvh->bounds(), mvp)) {
            continue;
        }
        const Geometry& geometry = geometry_of(item);
        set_sides(item, false);
        gl_->glUniformMatrix4fv(place, 1, GL_FALSE, &mvp[0][0]);
        bind(item, geometry, lighting_of(item));
        gl_->glDrawElements(GL_TRIANGLES, geometry.count, GL_UNSIGNED_INT, nullptr);
    }
    gl_->glFrontFace(GL_CCW);
    gl_->glDisable(GL_CULL_FACE);
    gl_->glBindVertexArray(0);
    mask_->release();
}

void GpuScene::draw_edges(const ViewScene& view, const DrawView& from) {
    gl_->glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    gl_->glEnable(GL_POLYGON_OFFSET_LINE);
    gl_->glPolygonOffset(-1.0F, -1.0F);
    gl_->glEnable(GL_BLEND);
    gl_->glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    draw_mask(view, from, vec4(0.05F, 0.1F, 0.2F, 0.45F),
              [&from](const ViewItem& item) { return from.cutaway.part_of(item.bounds) != Cutaway::Part::All; });
    gl_->glDisable(GL_BLEND);
    gl_->glDisable(GL_POLYGON_OFFSET_LINE);
    gl_->glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

} // namespace atrium::ui
