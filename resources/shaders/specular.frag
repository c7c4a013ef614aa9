#version 330 core
// Traced mirrors and glass over the picture: exposure, filmic curve and sRGB as in surface.frag and engine/view/tone.h.
uniform sampler2D u_picture; // radiance times cover, cover in alpha; rows from the top
uniform float u_exposure;
in vec2 v_at;
out vec4 o_color;

void main() {
    vec4 seen = textureLod(u_picture, v_at, 0.0);
    vec3 x = max(seen.rgb / max(seen.a, 1e-6), vec3(0.0)) * u_exposure;
    vec3 l = min((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(1.0));
    vec3 shown = mix(12.92 * l, 1.055 * pow(max(l, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), l));
    o_color = vec4(shown * seen.a, seen.a);
}
