#include "ui/viewport/scene_figures.h"

#include "ui/viewport/gpu_scene_parts.h"

#include <algorithm>
#include <cstddef>

namespace atrium::ui {

FigureColor figure_color(const Rgb& display, float alpha) {
    const auto byte = [](float x) { return std::uint8_t(std::lround(255.0F * std::clamp(x, 0.0F, 1.0F))); };
    return {byte(display.r), byte(display.g), byte(display.b), byte(alpha)};
}

bool SceneFigures::initialize(Gl& gl) {
    gl_ = &gl;
    fill_ = load_program("figure_fill.vert", "figure_fill.frag");
    line_ = load_program("figure_line.vert", "figure_line.frag");
    return fill_ && line_;
}

void SceneFigures::release() {
    if (gl_ == nullptr) {
        return;
    }
    for (const auto& [set, buffers] : uploaded_) {
        forget(buffers);
    }
    uploaded_.clear();
    fill_.reset();
    line_.reset();
    gl_ = nullptr;
}

void SceneFigures::forget(const Buffers& buffers) {
    for (const Buffers::Group& group : buffers.groups) {
        gl_->glDeleteVertexArrays(2, group.array.data());
        gl_->glDeleteBuffers(2, group.buffer.data());
    }
}

const SceneFigures::Buffers& SceneFigures::buffers_of(const std::shared_ptr<const FigureSet>& set) {
    Buffers& out = uploaded_[set.get()];
    if (out.set) {
        return out;
    }
    Gl& gl = *gl_;
    out.set = set;
    for (const FigureGroup& group : set->groups) {
        Buffers::Group& g = out.groups.emplace_back();
        gl.glGenVertexArrays(2, g.array.data());
        gl.glGenBuffers(2, g.buffer.data());
        const auto attribute = [&](GLuint index, GLint size, GLenum type, std::size_t stride, std::size_t at,
                                   GLuint divisor) {
            gl.glEnableVertexAttribArray(index);
            gl.glVertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, GLsizei(stride),
                                     reinterpret_cast<const void*>(at));
            gl.glVertexAttribDivisor(index, divisor);
        };
        gl.glBindVertexArray(g.array[0]);
        gl.glBindBuffer(GL_ARRAY_BUFFER, g.buffer[0]);
        gl.glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(group.corners.size() * sizeof(FigureCorner)), group.corners.data(),
                        GL_STATIC_DRAW);
        attribute(0, 3, GL_FLOAT, sizeof(FigureCorner), offsetof(FigureCorner, position), 0);
        attribute(1, 4, GL_UNSIGNED_BYTE, sizeof(FigureCorner), offsetof(FigureCorner, color), 0);
        gl.glBindVertexArray(g.array[1]);
        gl.glBindBuffer(GL_ARRAY_BUFFER, g.buffer[1]);
        gl.glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(group.lines.size() * sizeof(FigureLine)), group.lines.data(),
                        GL_STATIC_DRAW);
        attribute(0, 3, GL_FLOAT, sizeof(FigureLine), offsetof(FigureLine, from), 1);
        attribute(1, 3, GL_FLOAT, sizeof(FigureLine), offsetof(FigureLine, to), 1);
        attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(FigureLine), offsetof(FigureLine, color), 1);
        attribute(3, 4, GL_INT_2_10_10_10_REV, sizeof(FigureLine), offsetof(FigureLine, normal), 1);
        attribute(4, 1, GL_FLOAT, sizeof(FigureLine), offsetof(FigureLine, width), 1);
    }
    gl.glBindVertexArray(0);
    return out;
}

void SceneFigures::draw(const ViewScene& view, const DrawView& from, std::span<const ShownFigures> shown, const vec2& size,
                        float pixel_ratio) {
    std::erase_if(uploaded_, [&](const auto& entry) {
        const bool wanted = std::any_of(shown.begin(), shown.end(),
                                        [&](const ShownFigures& figures) { return figures.set.get() == entry.first; });
        if (!wanted) {
            forget(entry.second);
        }
        return !wanted;
    });
    if (shown.empty()) {
        return;
    }
    Gl& gl = *gl_;
    gl.glEnable(GL_DEPTH_TEST);
    gl.glDepthMask(GL_FALSE);
    gl.glEnable(GL_BLEND);
    gl.glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
    gl.glFrontFace(GL_CCW);
    gl.glCullFace(GL_BACK);
    const mat4 view_projection(from.projection * from.rotation);
    std::map<std::pair<NodeId, std::uint32_t>, const ViewItem*> items;
    for (const ViewItem& item : view.items()) {
        items[{item.node, item.part}] = &item;
    }
    // All triangles lie below all lines.
    for (const bool lines : {false, true}) {
        QOpenGLShaderProgram& program = lines ? *line_ : *fill_;
        const auto at = [&](const char* name) { return program.uniformLocation(name); };
        program.bind();
        gl.glUniformMatrix4fv(at("u_view_projection"), 1, GL_FALSE, &view_projection[0][0]);
        gl.glUniform1f(at("u_cut_facing"), float(Cutaway::kFacing));
        const vec3 plane(from.cutaway.plane() - from.eye);
        gl.glUniform3f(at("u_cut_plane"), plane.x, plane.y, plane.z);
        if (lines) {
            gl.glDisable(GL_CULL_FACE);
            gl.glUniform2f(at("u_size"), size.x, size.y);
            gl.glUniform1f(at("u_ratio"), pixel_ratio);
            gl.glUniform1f(at("u_near"), float(from.projection[3][2] / (from.projection[2][2] - 1.0)));
        } else {
            gl.glEnable(GL_CULL_FACE);
        }
        for (const ShownFigures& figures : shown) {
            const Buffers& buffers = buffers_of(figures.set);
            program.bind();
            gl.glUniform1f(at("u_alpha"), figures.alpha);
            for (std::size_t i = 0; i < buffers.groups.size(); ++i) {
                const FigureGroup& group = figures.set->groups[i];
                const std::size_t count = lines ? group.lines.size() : group.corners.size();
                const auto item = items.find({group.node, group.part});
                if (count == 0 || (group.node && (item == items.end() || item->second->flattened))) {
                    continue;
                }
                Cutaway::Part cut = Cutaway::Part::None;
                dmat4 model(1.0);
                model[3] = dvec4(group.origin - from.eye, 1.0);
                if (group.node) {
                    cut = from.cutaway.part_of(item->second->bounds);
                    model = relative_to_eye(*item->second, from.eye);
                }
                if (cut == Cutaway::Part::All) {
                    continue;
                }
                const vec3 side(cut == Cutaway::Part::Some ? from.cutaway.side() : dvec3(0.0));
                gl.glUniform3f(at("u_cut_side"), side.x, side.y, side.z);
                const mat4 place(model);
                gl.glUniformMatrix4fv(at("u_model"), 1, GL_FALSE, &place[0][0]);
                gl.glBindVertexArray(buffers.groups[i].array[lines ? 1 : 0]);
                if (lines) {
                    const mat3 normal(glm::transpose(glm::inverse(dmat3(model))));
                    gl.glUniformMatrix3fv(at("u_normal"), 1, GL_FALSE, &normal[0][0]);
                    gl.glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, GLsizei(count));
                } else {
                    gl.glDrawArrays(GL_TRIANGLES, 0, GLsizei(count));
                }
            }
        }
        program.release();
    }
    gl.glBindVertexArray(0);
    gl.glDisable(GL_CULL_FACE);
    gl.glDisable(GL_BLEND);
    gl.glDepthMask(GL_TRUE);
}

} // namespace atrium::ui
