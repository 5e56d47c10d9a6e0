// From linear radiance to what a screen shows, as brdf.render.tone.
uniform float exposure;  // a factor
uniform int tone_curve;  // 0 clip, 1 reinhard, 2 filmic, 3 neutral, 4 linear

const float MIDDLE_GREY = 0.18;
const float FILMIC_SCALE = 0.7231708;
const float NEUTRAL_SHOULDER = 0.76;

vec3 srgb_encode(vec3 x) {
    return mix(12.92 * x, 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, x));
}

vec3 neutral(vec3 x) {
    float least = min(x.r, min(x.g, x.b));
    x -= least < 0.08 ? least * (1.0 - 6.25 * least) : 0.04;
    float peak = max(x.r, max(x.g, x.b)), room = 1.0 - NEUTRAL_SHOULDER;
    if (peak < NEUTRAL_SHOULDER) return x;
    float compressed = 1.0 - room * room / (peak + room - NEUTRAL_SHOULDER);
    return compressed * mix(vec3(1.0), x / peak, 1.0 / (0.15 * (peak - compressed) + 1.0));
}

vec3 developed(vec3 linear) {
    vec3 x = clamp(linear * exposure, 0.0, 1e4);
    if (tone_curve == 1) { x /= 1.0 - MIDDLE_GREY; x = x / (1.0 + x); }
    if (tone_curve == 2) { x *= FILMIC_SCALE; x = x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14); }
    if (tone_curve == 3) x = neutral(x);
    x = clamp(x, 0.0, 1.0);
    return tone_curve == 4 ? x : srgb_encode(x);
}
