#version 330 core
// Lines in the scene as quads of a width in pixels: four corners of a strip for every line.
layout(location = 0) in vec3 a_from;
layout(location = 1) in vec3 a_to;
layout(location = 2) in vec4 a_color;
layout(location = 3) in vec4 a_normal; // of the side that it lies on, 0 where it lies on none
layout(location = 4) in float a_width; // logical pixels
uniform mat4 u_model;                  // local to world axes, relative to the eye
uniform mat4 u_view_projection;
uniform mat3 u_normal;
uniform vec2 u_size;   // of the target, pixels
uniform float u_ratio; // pixels for a logical one
uniform float u_near;
uniform float u_alpha;
out vec4 v_color;
out float v_side; // pixels from the middle of the line
out float v_half; // half its width
out vec3 v_position;
out vec3 v_normal;

const float kNearer = 1.5e-3; // of the distance from the eye, or half of every line would be lost in its surface

void main() {
    gl_Position = vec4(2.0, 2.0, 2.0, 1.0); // nowhere
    vec3 from = (u_model * vec4(a_from, 1.0)).xyz;
    vec3 to = (u_model * vec4(a_to, 1.0)).xyz;
    v_normal = dot(a_normal.xyz, a_normal.xyz) > 0.1 ? normalize(u_normal * a_normal.xyz) : vec3(0.0);
    if (dot(v_normal, from + to) > 0.0) {
        return; // on the other side of a sheet
    }
    vec4 p = u_view_projection * vec4(from * (1.0 - kNearer), 1.0);
    vec4 q = u_view_projection * vec4(to * (1.0 - kNearer), 1.0);
    if (p.w < u_near && q.w < u_near) {
        return;
    }
    if (p.w < u_near) {
        p = mix(p, q, (u_near - p.w) / (q.w - p.w));
    } else if (q.w < u_near) {
        q = mix(q, p, (u_near - q.w) / (p.w - q.w));
    }
    vec2 s = 0.5 * u_size * p.xy / p.w;
    vec2 t = 0.5 * u_size * q.xy / q.w;
    vec2 along = distance(s, t) > 1e-4 ? normalize(t - s) : vec2(1.0, 0.0);
    v_half = 0.5 * max(a_width * u_ratio, 1.0);
    float reach = v_half + 0.5; // with a soft edge
    bool second = (gl_VertexID & 1) != 0;
    v_side = (gl_VertexID & 2) != 0 ? reach : -reach;
    vec4 clip = second ? q : p;
    vec2 place = (second ? t + along * v_half : s - along * v_half) + vec2(-along.y, along.x) * v_side;
    gl_Position = vec4(place / (0.5 * u_size) * clip.w, clip.z, clip.w);
    v_position = second ? to : from;
    v_color = vec4(a_color.rgb, a_color.a * u_alpha);
}
