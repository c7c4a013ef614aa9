#version 330 core
// Compiled in variants, since a software rasteriser executes every branch: TEXTURED (textures, alpha mask), SPECULAR (metal
// and glass), HEADLIGHT (no light known yet), CUT (walls that hide the room from outside are left out, see cutaway.h),
// LIGHT_MAP (direct light in a map, engine/layers/light_map.h), CAUSTICS (engine/caustics/caustic_texture.h), MEASURE (amounts
// of light in false colour instead of the picture, engine/view/false_color.h).
// radiance = emitted + rho * irradiance / pi, then exposure, filmic curve and sRGB as in engine/view/tone.h.
in vec3 v_position;
in vec3 v_normal;
in vec2 v_base_uv;
in vec2 v_emissive_uv;
in vec3 v_color;
centroid in vec3 v_front; // off its triangle light between a bright and a dark vertex would run over
centroid in vec3 v_back;
#if defined(LIGHT_MAP) || defined(CAUSTICS)
centroid in vec2 v_light_uv; // tiles
flat in float v_charted;
#endif
#ifdef LIGHT_MAP
uniform sampler2D u_map;        // irradiance / u_map_scale
uniform usampler2D u_map_tiles; // first sample x, y; level; used
uniform float u_map_scale;      // lux
#endif
#ifdef CAUSTICS
uniform sampler2D u_caustic_image; // irradiance / u_caustic_scale, all textures of the side
uniform sampler2D u_caustic_boxes; // by row: rectangle low, high in tiles; place in the image x, y, width, height
uniform int u_caustic_count;
uniform vec4 u_caustic_bounds; // around all rectangles: low, high
uniform float u_caustic_scale; // lux
uniform float u_caustic_outline; // 1 = outline the rectangles
uniform float u_caustic_grid;    // 1 = draw lines between texels
#endif

uniform vec4 u_base;    // linear colour and alpha
uniform vec3 u_emitted; // cd/m2
uniform sampler2D u_base_texture;
uniform sampler2D u_emissive_texture;
uniform bool u_base_textured;
uniform bool u_emissive_textured;
uniform bool u_has_back;
uniform bool u_unlit_material;
uniform int u_alpha_mode; // 0 opaque, 1 mask, 2 blend
uniform float u_alpha_cutoff;
uniform int u_kind; // 0 diffuse, 1 metal, 2 glass
uniform float u_roughness;
uniform float u_f0;
uniform float u_diffuse_share; // of what is not transmitted
uniform bool u_has_probe;
uniform samplerCube u_probe; // linear radiance
uniform float u_probe_levels;
uniform vec3 u_probe_centre; // all relative to the eye
uniform vec3 u_room_min;
uniform vec3 u_room_max;
uniform vec3 u_filter; // what the mirror that one looks into leaves of the light
uniform float u_exposure;
uniform bool u_linear; // the probe keeps radiance

#ifdef MEASURE
uniform sampler2D u_color_map; // one row, dark to bright
uniform bool u_illuminance;    // else luminance
uniform bool u_known;          // false where the surface has no such amount
uniform bool u_logarithmic;
uniform vec2 u_range;          // ends of the scale; their logarithms on a logarithmic one
uniform int u_level_count;
uniform float u_levels[24];    // where contours run
uniform float u_line;          // half the width of a contour, pixels
#endif

#ifdef CUT
uniform vec3 u_cut_side;
uniform vec3 u_cut_plane; // relative to the eye
uniform float u_cut_facing;
#endif

out vec4 o_color;

const float kInvPi = 0.31830988618379067;

vec3 filmic(vec3 exposed) {
    vec3 x = max(exposed, vec3(0.0));
    return min((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(1.0));
}

vec3 encode(vec3 l) {
    return mix(12.92 * l, 1.055 * pow(max(l, vec3(0.0031308)), vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), l));
}

vec4 shown(vec3 radiance, float alpha) {
    return u_linear ? vec4(min(radiance, vec3(60000.0)), alpha) : vec4(encode(filmic(radiance * u_exposure)), alpha);
}

#ifdef SPECULAR
// The room's walls bend the direction, so that a flat mirror shows things about where they are.
vec3 reflected(vec3 direction, float roughness) {
    vec3 far_corner = mix(u_room_min, u_room_max, step(vec3(0.0), direction));
    vec3 t = (far_corner - v_position) / (direction + vec3(equal(direction, vec3(0.0))) * 1e-6);
    float reach = max(min(t.x, min(t.y, t.z)), 0.0);
    return textureLod(u_probe, v_position + direction * reach - u_probe_centre, roughness * u_probe_levels).rgb;
}
#endif

#ifdef LIGHT_MAP
// LightMap::irradiance().
vec3 mapped(vec2 uv) {
    ivec2 last = textureSize(u_map_tiles, 0) - 1;
    ivec2 at = clamp(ivec2(floor(uv)), ivec2(0), last);
    uvec4 tile = texelFetch(u_map_tiles, at, 0);
    // On an unused tile the nearest used one of the eight around. A loop, since a software rasteriser leaves it when no
    // fragment needs it, while it executes both sides of every branch.
    ivec2 middle = at;
    float nearest = 1e30;
    for (int k = tile.w == 0u ? 0 : 9; k < 9; ++k) {
        ivec2 other = middle + ivec2(k % 3, k / 3) - 1;
        if (other == clamp(other, ivec2(0), last)) {
            uvec4 found = texelFetch(u_map_tiles, other, 0);
            vec2 d = uv - clamp(uv, vec2(other), vec2(other + 1));
            float distance2 = dot(d, d);
            if (found.w != 0u && distance2 < nearest) {
                nearest = distance2;
                at = other;
                tile = found;
            }
        }
    }
    // Texel centres are the samples. A little inside the tile: a rounding beyond its last sample would mix in another
    // tile's light, and sun beside shadow shows at a thousandth.
    float n = float(1u << tile.z);
    vec2 inside = clamp(clamp(uv - vec2(at), 0.0, 1.0) * n, 0.002, n - 0.002);
    vec3 light = textureLod(u_map, (vec2(tile.xy) + inside + 0.5) / vec2(textureSize(u_map, 0)), 0.0).rgb;
    return tile.w == 0u ? vec3(0.0) : light * u_map_scale;
}
#endif

#ifdef CAUSTICS
// Sum of CausticTexture::irradiance(); `edge` is how much of a white outline (x), of the dark line within it (y) and of a
// line between texels (z) is here.
vec3 caustics(vec2 uv, vec2 pixel, out vec3 edge) {
    bool near = uv == clamp(uv, u_caustic_bounds.xy, u_caustic_bounds.zw);
    vec2 texel = 1.0 / vec2(textureSize(u_caustic_image, 0));
    vec3 sum = vec3(0.0);
    edge = vec3(0.0);
    for (int i = near ? 0 : u_caustic_count; i < u_caustic_count; ++i) {
        vec4 box = texelFetch(u_caustic_boxes, ivec2(0, i), 0);
        if (uv == clamp(uv, box.xy, box.zw)) {
            vec4 place = texelFetch(u_caustic_boxes, ivec2(1, i), 0);
            // A little inside the outermost texels' middles: a rounding beyond would mix in another texture's light.
            vec2 at = clamp((uv - box.xy) / (box.zw - box.xy) * place.zw, vec2(0.502), place.zw - 0.502);
            sum += textureLod(u_caustic_image, (place.xy + at) * texel, 0.0).rgb;
            vec2 inside = min(uv - box.xy, box.zw - uv) / pixel;
            // Thinner lines in boxes of a few pixels, which would be nothing but outline.
            vec2 size = (box.zw - box.xy) / pixel;
            float line = clamp(0.1 * min(size.x, size.y), 0.3, 2.0);
            edge.xy = max(edge.xy, clamp(vec2(1.0, 1.75) * line - min(inside.x, inside.y), 0.0, 1.0));
            // Pixels to the nearest line; where texels are small the lines fade, for they would be a grey.
            vec2 cell = size / place.zw;
            vec2 away = (0.5 - abs(fract((uv - box.xy) / (box.zw - box.xy) * place.zw) - 0.5)) * cell;
            float seen = smoothstep(3.0, 6.0, min(cell.x, cell.y));
            edge.z = max(edge.z, seen * clamp(1.0 - min(away.x, away.y), 0.0, 1.0));
        }
    }
    edge *= vec3(u_caustic_outline, u_caustic_outline, u_caustic_grid);
    return sum * u_caustic_scale;
}
#endif

#ifdef MEASURE
const vec3 kLuminance = vec3(0.2126, 0.7152, 0.0722);

// Forms stay readable in grey, which no amount has.
vec3 unknown(float facing) { return vec3(mix(0.30, 0.58, facing)); }

// scale_place() and map_color().
vec3 in_false_color(float amount) {
    float at = u_logarithmic ? log(max(amount, 1e-12)) : amount;
    float place = clamp((at - u_range.x) / (u_range.y - u_range.x), 0.0, 1.0);
    float size = float(textureSize(u_color_map, 0).x);
    vec3 color = textureLod(u_color_map, vec2((place * (size - 1.0) + 0.5) / size, 0.5), 0.0).rgb;
    // Change over a pixel; even light that happens to lie at a level is no line.
    float slope = max(fwidth(amount), 1e-6 * amount + 1e-12);
    float line = 0.0;
#ifdef TEXTURED
    int count = u_illuminance ? u_level_count : 0; // every knot in the wood would have its own
#else
    int count = u_level_count;
#endif
    for (int i = 0; i < count; ++i) {
        line = max(line, clamp(u_line + 0.5 - abs(amount - u_levels[i]) / slope, 0.0, 1.0));
    }
    return mix(color, vec3(place < 0.55 ? 1.0 : 0.0), 0.85 * line);
}
#endif

void main() {
#ifdef CUT
    if (any(greaterThan(u_cut_side * (v_position - u_cut_plane) * step(u_cut_facing, abs(normalize(v_normal))), vec3(0.0)))) {
        discard;
    }
#endif
    vec4 base = u_base * vec4(v_color, 1.0);
    vec3 emitted = u_emitted;
#ifdef TEXTURED
    if (u_base_textured) {
        base *= texture(u_base_texture, v_base_uv);
    }
    if (u_alpha_mode == 1 && base.a < u_alpha_cutoff) {
        discard;
    }
    if (u_emissive_textured) {
        emitted *= texture(u_emissive_texture, v_emissive_uv).rgb;
    }
#endif
    float alpha = u_alpha_mode == 2 ? base.a : 1.0;
#ifdef MEASURE
    // A mixture of two colours would stand for an amount that is nowhere.
    if (alpha < 0.5) {
        discard;
    }
    alpha = 1.0;
#endif
    vec3 rho = clamp(base.rgb, vec3(0.0), vec3(0.9999)); // kMaxReflectance
    vec3 irradiance = gl_FrontFacing || !u_has_back ? v_front : v_back;
#ifdef LIGHT_MAP
    irradiance += v_charted * mapped(v_light_uv);
#endif
#ifdef CAUSTICS
    vec3 edge;
    irradiance += v_charted * caustics(v_light_uv, max(fwidth(v_light_uv), vec2(1e-9)), edge);
    edge *= v_charted;
#endif
    vec3 radiance = emitted + rho * u_diffuse_share * max(irradiance, vec3(0.0)) * kInvPi;

#if defined(SPECULAR) || defined(HEADLIGHT) || defined(MEASURE)
    vec3 eye = normalize(-v_position);
    vec3 normal = normalize(v_normal);
    normal = gl_FrontFacing ? normal : -normal;
    float facing = clamp(dot(normal, eye), 0.0, 1.0);
#endif
#ifdef HEADLIGHT
    // A headlight on pale material, the same at any exposure.
    vec3 pale = mix(vec3(dot(rho, vec3(0.2126, 0.7152, 0.0722))), rho, 0.4);
    radiance = emitted + 0.25 * (0.35 + 0.65 * facing) * (0.15 + 0.85 * pale) / u_exposure;
#endif
#ifdef SPECULAR
    float schlick = pow(1.0 - facing, 5.0);
    if (u_kind == 2) {
        // Glass lies over what is behind it: its own part is what it reflects.
        float fresnel = u_f0 + (1.0 - u_f0) * schlick;
        vec3 mirror = u_has_probe ? reflected(reflect(-eye, normal), 0.0) : vec3(0.18 / u_exposure);
        float tint = 1.0 - min(base.r, min(base.g, base.b));
        alpha = clamp(fresnel + 0.35 * tint + 0.04, 0.0, 1.0);
        radiance = (mirror * fresnel + base.rgb * 0.35 * tint * 0.18 / u_exposure) / alpha + emitted;
    } else {
        vec3 fresnel = rho + (vec3(1.0) - rho) * schlick * (1.0 - u_roughness);
        // Until the probe is drawn a mirror is an even grey; its own irradiance would make it a bright wall.
        vec3 seen = u_has_probe ? reflected(reflect(-eye, normal), sqrt(u_roughness)) : vec3(0.18 / u_exposure);
        vec3 mirror = emitted + fresnel * seen;
        radiance = mix(mirror, radiance, smoothstep(0.35, 0.9, u_roughness));
    }
#endif
#ifdef MEASURE
    float amount = dot(u_illuminance ? max(irradiance, vec3(0.0)) : radiance * u_filter, kLuminance);
    vec3 told = in_false_color(amount);
    o_color = vec4(u_known ? told : unknown(facing), alpha);
#else
    if (u_unlit_material) {
        o_color = u_linear ? vec4(base.rgb / u_exposure, alpha) : vec4(encode(base.rgb), alpha);
    } else {
        o_color = shown(radiance * u_filter, alpha);
    }
#endif
#ifdef CAUSTICS
    // White, and dark within: seen on any light.
    o_color = mix(o_color, vec4(0.1, 0.45, 0.9, 1.0), 0.7 * edge.z);
    o_color = mix(mix(o_color, vec4(0.0, 0.0, 0.0, 1.0), 0.6 * edge.y), vec4(1.0), edge.x);
#endif
}
