// From the pictures of one or two materials to what the screen shows: backdrop, comparison, tone curve.

/** Vertex shader of a triangle over the whole target. */
export const COVER = /* glsl */ `
void main() {
    gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 1.0, 1.0);
}`;

/** A finished pass, into the mean of all: blending weighs it. */
export const ADD = /* glsl */ `
precision highp float;
precision highp sampler2D;
uniform sampler2D pass;
out vec4 colour;
void main() { colour = clamp(texelFetch(pass, ivec2(gl_FragCoord.xy), 0), -6e4, 6e4); }`;

/** What `shown` counts: the first material, the second, both beside a divider, their difference. */
export const SHOWN = { first: 0, second: 1, split: 2, difference: 3 };

/** What `background` counts. */
export const BACKGROUNDS = { gradient: 0, environment: 1, plain: 2 };

/**
 * Behind the shape stands what brdf.render.background paints; the difference is that of what is shown, times a gain.
 * @param {string} tone the stages' tone curves
 */
export function presentation(tone) {
    return /* glsl */ `
precision highp float;
precision highp int;
precision highp sampler2D;
${tone}
uniform sampler2D first, second;  // radiance and coverage
uniform vec2 first_size, second_size;  // what of them is drawn
uniform vec4 place;  // of the picture in the target: its left, bottom, width, height
uniform int shown, background;
uniform float divider, gain;
uniform vec3 plain;
uniform mat3 camera_frame;
uniform float camera_half;
uniform sampler2D backdrop;
uniform vec2 environment_turn;
uniform float environment_scale;
out vec4 colour;

vec3 behind(vec2 at) {
    if (background == 2) return plain;
    if (background == 0) {
        vec2 offset = at / place.zw - vec2(0.5, 0.45);
        float left = 1.0 - min(dot(offset, offset) / 0.5, 1.0);
        return vec3(0.035 + 0.125 * left * left);
    }
    vec2 across = (2.0 * at - place.zw) / place.w * vec2(camera_half, -camera_half);
    vec3 d = normalize(camera_frame * vec3(across, -1.0));
    d = vec3(environment_turn.x * d.x - environment_turn.y * d.z, d.y,
             environment_turn.y * d.x + environment_turn.x * d.z);
    ivec2 size = textureSize(backdrop, 0);
    vec2 texel = vec2(atan(d.x, -d.z) / 6.28318531 + 0.5, acos(clamp(d.y, -1.0, 1.0)) / 3.14159265) * vec2(size) - 0.5;
    ivec2 i = ivec2(floor(texel));
    vec2 f = texel - floor(texel);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; k++) {
        ivec2 j = i + ivec2(k & 1, k >> 1);
        j = ivec2((j.x + size.x) % size.x, clamp(j.y, 0, size.y - 1));
        vec2 weight = mix(1.0 - f, f, vec2(k & 1, k >> 1));
        sum += weight.x * weight.y * texelFetch(backdrop, j, 0).rgb;
    }
    return sum * environment_scale;
}

vec4 seen(sampler2D picture, vec2 size, vec2 at) {
    if (size == place.zw) return texelFetch(picture, ivec2(at), 0);
    vec2 texel = at / place.zw * size - 0.5, f = fract(texel);
    ivec2 i = ivec2(floor(texel)), last = ivec2(size) - 1;
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; k++) {
        ivec2 corner = ivec2(k & 1, k >> 1);
        vec2 weight = mix(1.0 - f, f, vec2(corner));
        sum += weight.x * weight.y * texelFetch(picture, clamp(i + corner, ivec2(0), last), 0);
    }
    return sum;
}

vec3 composed(vec4 radiance, vec3 backdrop) { return developed(radiance.rgb + (1.0 - radiance.a) * backdrop); }

void main() {
    vec2 at = gl_FragCoord.xy - place.xy;
    vec3 back = behind(vec2(at.x, place.w - at.y));
    bool other = shown == 1 || (shown == 2 && at.x >= divider * place.z);
    vec3 value = other ? composed(seen(second, second_size, at), back) : composed(seen(first, first_size, at), back);
    if (shown == 3) value = abs(value - composed(seen(second, second_size, at), back)) * gain;
    colour = vec4(value, 1.0);
}`;
}
