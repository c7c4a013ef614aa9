// The cube map that metals and glass show.
#include "ui/viewport/gpu_scene_parts.h"

namespace atrium::ui {
namespace {

constexpr int kProbeSize = 128;

} // namespace

bool GpuScene::begin_probe(const ViewScene& view, const DBox3& room) {
    const bool wanted = !room.empty() && std::any_of(view.items().begin(), view.items().end(), [](const ViewItem& item) {
        return is_glass(*item.material) || is_metal(*item.material);
    });
    Gl& gl = *gl_;
    if (!wanted) {
        gl.glDeleteTextures(1, &probe_.texture);
        probe_ = {};
        return false;
    }
    if (next_probe_.texture == 0) {
        gl.glGenTextures(1, &next_probe_.texture);
        gl.glBindTexture(GL_TEXTURE_CUBE_MAP, next_probe_.texture);
        for (GLenum face = 0; face < 6; ++face) {
            gl.glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, GL_RGBA16F, kProbeSize, kProbeSize, 0, GL_RGBA,
                            GL_FLOAT, nullptr);
        }
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        gl.glTexParameteri(GL_TEXTURE_CUBE_MAP, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    }
    next_probe_.room = room;
    next_probe_.centre = room.centre();
    return true;
}

void GpuScene::draw_probe_face(const ViewScene& view, const Scene& scene, unsigned face, float exposure,
                               const LightShares& shares) {
    Gl& gl = *gl_;
    unsigned framebuffer = 0;
    unsigned depth = 0;
    gl.glGenFramebuffers(1, &framebuffer);
    gl.glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    gl.glGenRenderbuffers(1, &depth);
    gl.glBindRenderbuffer(GL_RENDERBUFFER, depth);
    gl.glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, kProbeSize, kProbeSize);
    gl.glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth);
    gl.glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_CUBE_MAP_POSITIVE_X + face,
                              next_probe_.texture, 0);
    gl.glViewport(0, 0, kProbeSize, kProbeSize);

    // Cube map faces look along +x -x +y -y +z -z with these upward directions (OpenGL's own convention).
    constexpr std::array<std::array<int, 6>, 6> kFaces{{{1, 0, 0, 0, -1, 0},
                                                        {-1, 0, 0, 0, -1, 0},
                                                        {0, 1, 0, 0, 0, 1},
                                                        {0, -1, 0, 0, 0, -1},
                                                        {0, 0, 1, 0, -1, 0},
                                                        {0, 0, -1, 0, -1, 0}}};
    const auto& f = kFaces[face];
    const dvec3 ahead(f[0], f[1], f[2]);
    const dvec3 up(f[3], f[4], f[5]);
    const dvec3 right = glm::cross(ahead, up);
    DrawView from;
    from.eye = next_probe_.centre;
    from.exposure = exposure;
    from.linear = true;
    from.use_probe = false;
    from.shares = shares;
    from.rotation = glm::transpose(dmat4(dvec4(right, 0), dvec4(up, 0), dvec4(-ahead, 0), dvec4(0, 0, 0, 1)));
    const double near_plane = 0.02;
    const double far_plane = std::max(2.0 * next_probe_.room.diagonal(), 10.0);
    from.projection = dmat4(0.0);
    from.projection[0][0] = from.projection[1][1] = 1.0;
    from.projection[2][2] = -(far_plane + near_plane) / (far_plane - near_plane);
    from.projection[2][3] = -1.0;
    from.projection[3][2] = -2.0 * far_plane * near_plane / (far_plane - near_plane);
    const Rgb sky = scene.environment.sky_radiance;
    gl.glClearColor(sky.r, sky.g, sky.b, 1.0F);
    gl.glDepthMask(GL_TRUE);
    gl.glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    draw(view, scene, from);
    gl.glDeleteFramebuffers(1, &framebuffer);
    gl.glDeleteRenderbuffers(1, &depth);
    if (face == 5) {
        gl.glBindTexture(GL_TEXTURE_CUBE_MAP, next_probe_.texture);
        gl.glGenerateMipmap(GL_TEXTURE_CUBE_MAP);
        std::swap(probe_, next_probe_);
    }
}

} // namespace atrium::ui
