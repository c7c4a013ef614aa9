#version 330 core
// Walls that are cut away take what lies on them with them: see ui/viewport/cutaway.h.
in vec4 v_color;
in vec3 v_position;
uniform vec3 u_cut_side; // 0 where nothing is cut
uniform vec3 u_cut_plane;
uniform float u_cut_facing;
out vec4 o_color;
void main() {
    vec3 normal = normalize(cross(dFdx(v_position), dFdy(v_position)));
    if (any(greaterThan(u_cut_side * (v_position - u_cut_plane) * step(u_cut_facing, abs(normal)), vec3(0.0)))) {
        discard;
    }
    o_color = v_color;
}
