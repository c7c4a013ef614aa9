#version 330 core
// One lit or unlit surface. Positions come out relative to the eye, in world axes.
layout(location = 0) in vec3 a_position;
layout(location = 1) in vec4 a_normal; // packed, w unused
layout(location = 2) in vec2 a_uv0;
layout(location = 3) in vec2 a_uv1;
layout(location = 4) in vec3 a_color;
layout(location = 5) in vec3 a_irradiance_front;
layout(location = 6) in vec3 a_irradiance_back;
layout(location = 7) in vec2 a_light_uv;

uniform mat4 u_mvp;
uniform mat4 u_model;  // local to world axes, relative to the eye
uniform mat3 u_normal; // inverse transpose of the same
uniform vec3 u_base_row0; // texture transforms (KHR_texture_transform), two rows
uniform vec3 u_base_row1;
uniform vec3 u_emissive_row0;
uniform vec3 u_emissive_row1;
uniform vec4 u_clip; // plane that a mirror's picture is cut at, relative to the eye
uniform int u_base_set;
uniform int u_emissive_set;

out vec3 v_position;
out vec3 v_normal;
out vec2 v_base_uv;
out vec2 v_emissive_uv;
out vec3 v_color;
centroid out vec3 v_front;
centroid out vec3 v_back;
centroid out vec2 v_light_uv; // never off the triangle, where another chart's tiles may lie
flat out float v_charted;     // 1 where the triangle has a place in the light map

void main() {
    gl_Position = u_mvp * vec4(a_position, 1.0);
    v_position = (u_model * vec4(a_position, 1.0)).xyz;
    gl_ClipDistance[0] = dot(u_clip, vec4(v_position, 1.0));
    v_normal = u_normal * a_normal.xyz;
    vec3 base_uv = vec3(u_base_set == 0 ? a_uv0 : a_uv1, 1.0);
    vec3 emissive_uv = vec3(u_emissive_set == 0 ? a_uv0 : a_uv1, 1.0);
    v_base_uv = vec2(dot(u_base_row0, base_uv), dot(u_base_row1, base_uv));
    v_emissive_uv = vec2(dot(u_emissive_row0, emissive_uv), dot(u_emissive_row1, emissive_uv));
    v_color = a_color;
    v_front = a_irradiance_front;
    v_back = a_irradiance_back;
    v_light_uv = a_light_uv;
    v_charted = step(0.0, a_light_uv.x);
}
