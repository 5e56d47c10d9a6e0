// From linear radiance to what a screen shows, as brdf.render.tone.
uniform float exposure;  // a factor
uniform int tone_curve;  // 0 clip, 1 reinhard, 2 filmic

const float MIDDLE_GREY = 0.18;
const float FILMIC_SCALE = 0.7231708;

vec3 srgb_encode(vec3 x) {
    return mix(12.92 * x, 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

vec3 developed(vec3 linear) {
    vec3 x = clamp(linear * exposure, 0.0, 1e4);
    if (tone_curve == 1) { x /= 1.0 - MIDDLE_GREY; x = x / (1.0 + x); }
    if (tone_curve == 2) { x *= FILMIC_SCALE; x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }
    return srgb_encode(clamp(x, 0.0, 1.0));
}
