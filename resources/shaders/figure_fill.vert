#version 330 core
// Coloured triangles that lie on surfaces.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec4 a_color;
uniform mat4 u_model; // local to world axes, relative to the eye
uniform mat4 u_view_projection;
uniform float u_alpha;
out vec4 v_color;
out vec3 v_position;

const float kNearer = 7e-4; // of the distance from the eye: above the surface, below lines

void main() {
    v_position = (u_model * vec4(a_position, 1.0)).xyz;
    gl_Position = u_view_projection * vec4(v_position * (1.0 - kNearer), 1.0);
    v_color = vec4(a_color.rgb, a_color.a * u_alpha);
}
