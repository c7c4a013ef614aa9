#version 330 core
// Edge of the mask: red channel = selected, green = under the cursor. A bright line with a dark seam outside it, so that
// it reads on white walls as well as in the dark.
uniform sampler2D u_mask;
uniform float u_radius; // device pixels
out vec4 o_color;

void main() {
    ivec2 size = textureSize(u_mask, 0);
    ivec2 at = ivec2(gl_FragCoord.xy);
    vec2 here = texelFetch(u_mask, at, 0).rg;
    vec2 close = here;
    vec2 wide = here;
    for (int i = 0; i < 8; ++i) {
        float angle = float(i) * 0.78539816;
        vec2 d = vec2(cos(angle), sin(angle));
        close = max(close, texelFetch(u_mask, clamp(at + ivec2(round(d * u_radius)), ivec2(0), size - 1), 0).rg);
        wide = max(wide, texelFetch(u_mask, clamp(at + ivec2(round(d * (u_radius + 1.0))), ivec2(0), size - 1), 0).rg);
    }
    vec2 line = close * (vec2(1.0) - here);
    vec2 seam = wide * (vec2(1.0) - here);
    if (line.r > 0.5) {
        o_color = vec4(1.0, 0.55, 0.05, 1.0);
    } else if (seam.r > 0.5) {
        o_color = vec4(0.1, 0.05, 0.0, 0.6);
    } else if (line.g > 0.5) {
        o_color = vec4(0.45, 0.75, 1.0, 0.8);
    } else {
        discard;
    }
}
