// Meshes of GpuScene's surfaces in buffers, and how the shaders read them.
#include "ui/viewport/gpu_scene_parts.h"

#include <cstddef>

namespace atrium::ui {
namespace {

struct Vertex {
    vec3 position;
    std::uint32_t normal = 0; ///< 2_10_10_10, signed
    vec2 uv0{0.0F};
    vec2 uv1{0.0F};
    vec3 color{1.0F};
};

const void* offset(std::size_t bytes) { return reinterpret_cast<const void*>(bytes); }

} // namespace

void GpuScene::forget(const Geometry& geometry) {
    gl_->glDeleteBuffers(1, &geometry.vertices);
    gl_->glDeleteBuffers(1, &geometry.indices);
    gl_->glDeleteBuffers(1, &geometry.light_uv);
}

const GpuScene::Geometry& GpuScene::geometry_of(const ViewItem& item) {
    Geometry& g = geometries_[item.mesh.get()];
    if (g.vertices != 0) {
        return g;
    }
    const DisplayMesh& mesh = *item.mesh;
    std::vector<Vertex> vertices(mesh.positions.size());
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        Vertex& v = vertices[i];
        v.position = mesh.positions[i];
        v.normal = i < mesh.normals.size() ? pack_normal(mesh.normals[i]) : pack_normal(vec3(0, 0, 1));
        v.uv0 = i < mesh.texcoords0.size() ? mesh.texcoords0[i] : vec2(0.0F);
        v.uv1 = i < mesh.texcoords1.size() ? mesh.texcoords1[i] : vec2(0.0F);
        v.color = i < mesh.colors.size() ? mesh.colors[i] : vec3(1.0F);
    }
    if (mesh.indices.size() >= 3 && mesh.normals.size() == mesh.positions.size()) {
        const vec3 origin = mesh.positions[mesh.indices[0]];
        g.normal = mesh.normals[mesh.indices[0]];
        const float tolerance = 1e-4F * item.bvh->bounds().diagonal();
        g.flat = true;
        for (std::size_t i = 0; i < mesh.positions.size() && g.flat; ++i) {
            g.flat = std::abs(glm::dot(mesh.positions[i] - origin, g.normal)) <= tolerance &&
                     glm::dot(mesh.normals[i], g.normal) > 0.9999F;
        }
    }
    g.mesh = item.mesh;
    g.count = int(mesh.indices.size());
    gl_->glBindVertexArray(0);
    gl_->glGenBuffers(1, &g.vertices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, g.vertices);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(vertices.size() * sizeof(Vertex)), vertices.data(), GL_STATIC_DRAW);
    gl_->glGenBuffers(1, &g.indices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, g.indices);
    gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.indices.size() * sizeof(std::uint32_t)), mesh.indices.data(),
                      GL_STATIC_DRAW);
    if (mesh.light_uv.size() == mesh.positions.size()) {
        gl_->glGenBuffers(1, &g.light_uv);
        gl_->glBindBuffer(GL_ARRAY_BUFFER, g.light_uv);
        gl_->glBufferData(GL_ARRAY_BUFFER, GLsizeiptr(mesh.light_uv.size() * sizeof(vec2)), mesh.light_uv.data(),
                          GL_STATIC_DRAW);
    }
    return g;
}

void GpuScene::bind(const ViewItem& item, const Geometry& geometry, const Lighting* lighting) {
    Array& array = arrays_[{item.node, item.part}];
    const SurfaceLayer* layer = lighting != nullptr ? item.layer.get() : nullptr;
    if (array.vao != 0 && array.mesh == item.mesh.get() && array.layer == layer) {
        gl_->glBindVertexArray(array.vao);
        return;
    }
    if (array.vao == 0) {
        gl_->glGenVertexArrays(1, &array.vao);
    }
    array.mesh = item.mesh.get();
    array.layer = layer;
    gl_->glBindVertexArray(array.vao);
    gl_->glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, geometry.indices);
    gl_->glBindBuffer(GL_ARRAY_BUFFER, geometry.vertices);
    const auto attribute = [&](GLuint index, GLint size, GLenum type, std::size_t at_byte) {
        gl_->glEnableVertexAttribArray(index);
        gl_->glVertexAttribPointer(index, size, type, type == GL_FLOAT ? GL_FALSE : GL_TRUE, sizeof(Vertex),
                                   offset(at_byte));
    };
    attribute(0, 3, GL_FLOAT, offsetof(Vertex, position));
    attribute(1, 4, GL_INT_2_10_10_10_REV, offsetof(Vertex, normal));
    attribute(2, 2, GL_FLOAT, offsetof(Vertex, uv0));
    attribute(3, 2, GL_FLOAT, offsetof(Vertex, uv1));
    attribute(4, 3, GL_FLOAT, offsetof(Vertex, color));
    if (geometry.light_uv != 0) {
        gl_->glBindBuffer(GL_ARRAY_BUFFER, geometry.light_uv);
        gl_->glEnableVertexAttribArray(7);
        gl_->glVertexAttribPointer(7, 2, GL_FLOAT, GL_FALSE, sizeof(vec2), nullptr);
    } else {
        gl_->glDisableVertexAttribArray(7);
    }
    for (const GLuint index : {5U, 6U}) {
        const bool present = lighting != nullptr && (index == 5 || lighting->has_back);
        if (!present) {
            gl_->glDisableVertexAttribArray(index);
            continue;
        }
        gl_->glBindBuffer(GL_ARRAY_BUFFER, lighting->values);
        gl_->glEnableVertexAttribArray(index);
        gl_->glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(Rgb),
                                   offset(index == 5 ? 0 : item.mesh->positions.size() * sizeof(Rgb)));
    }
}

void GpuScene::set_sides(const ViewItem& item, bool reflected) {
    // glTF: a mirroring transform turns the winding round, so that the front stays the front.
    gl_->glFrontFace(item.mirrored != reflected ? GL_CW : GL_CCW);
    if (item.material->double_sided) {
        gl_->glDisable(GL_CULL_FACE);
    } else {
        gl_->glEnable(GL_CULL_FACE);
    }
}

} // namespace atrium::ui
