#version 330 core
// Walls that are cut away take their lines with them: see ui/viewport/cutaway.h.
in vec4 v_color;
in float v_side;
in float v_half;
in vec3 v_position;
in vec3 v_normal;
uniform vec3 u_cut_side; // 0 where nothing is cut
uniform vec3 u_cut_plane;
uniform float u_cut_facing;
out vec4 o_color;
void main() {
    if (any(greaterThan(u_cut_side * (v_position - u_cut_plane) * step(u_cut_facing, abs(v_normal)), vec3(0.0)))) {
        discard;
    }
    o_color = vec4(v_color.rgb, v_color.a * clamp(v_half + 0.5 - abs(v_side), 0.0, 1.0));
}
