#version 330 core
// A picture over the view: `u_area` is its rectangle in clip coordinates (left, top, right, bottom).
uniform vec4 u_area;
out vec2 v_at;

void main() {
    v_at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    gl_Position = vec4(mix(u_area.xy, u_area.zw, v_at), 0.0, 1.0);
}
