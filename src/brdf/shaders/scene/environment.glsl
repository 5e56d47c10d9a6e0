// Light from all around, estimated with two kinds of directions at once, weighed by the balance heuristic [Veach1995]:
// by the environment's brightness, and by a lobe that stands in for the reflectance (GGX and a diffuse one).

uniform int environment_samples;           // a pass and kind; 0: there is no environment
uniform int environment_pass;              // 0, 1, 2, ...: passes draw other directions
uniform int environment_total;             // of a pixel's samples of each kind; 0: not known yet
uniform bool environment_dealt;            // each pixel begins with another of its passes, for means of few of them
uniform int environment_seed;
uniform sampler2D environment_map;         // radiance, and density of the brightness over solid angle [1/sr]
uniform sampler2D environment_directions;  // places (u, v) in the map, drawn by brightness: by number, row and column
uniform vec2 environment_turn;             // cosine and sine of the rotation about +y
uniform float environment_scale;           // of the radiance
uniform float lobe_alpha, lobe_share;      // width and probability of the stand-in's GGX lobe

const float TAU = 6.28318531;
const int MANY = 4096;  // stands in for a total that is not known

vec3 environment_direction(vec2 place) {
    float theta = place.y * TAU * 0.5, phi = (place.x - 0.5) * TAU;
    vec3 d = vec3(sin(theta) * sin(phi), cos(theta), -sin(theta) * cos(phi));
    return vec3(environment_turn.x * d.x + environment_turn.y * d.z, d.y,
                environment_turn.x * d.z - environment_turn.y * d.x);
}

vec4 environment_texel(ivec2 i) {
    ivec2 size = textureSize(environment_map, 0);
    return texelFetch(environment_map, ivec2((i.x + size.x) % size.x, clamp(i.y, 0, size.y - 1)), 0);
}

// Radiance, bilinear, and the density of the cell, for a world direction.
vec4 environment(vec3 d) {
    vec2 turned = vec2(environment_turn.x * d.x - environment_turn.y * d.z,
                       environment_turn.y * d.x + environment_turn.x * d.z);
    vec2 size = vec2(textureSize(environment_map, 0));
    vec2 place = vec2(angle_of(turned.x, -turned.y) / TAU + 0.5, angle_of(length(turned), d.y) / TAU * 2.0) * size;
    float density = environment_texel(min(ivec2(place), ivec2(size) - 1)).a;
    vec2 corner = floor(place - 0.5), f = place - 0.5 - corner;
    ivec2 i = ivec2(corner);
    vec3 upper = mix(environment_texel(i).rgb, environment_texel(i + ivec2(1, 0)).rgb, f.x);
    vec3 lower = mix(environment_texel(i + ivec2(0, 1)).rgb, environment_texel(i + ivec2(1, 1)).rgb, f.x);
    return vec4(mix(upper, lower, f.y) * environment_scale, density);
}

float lobe_density(vec3 wi, vec3 wo) {
    float matte = abs(wi.z) * 2.0 / TAU * (TRANSMITS ? 0.5 : 1.0);
    if (wi.z <= 0.0) return (1.0 - lobe_share) * (TRANSMITS ? matte : 0.0);
    vec3 h = normalize(wi + wo);
    float a2 = lobe_alpha * lobe_alpha, d = dot(h.xy, h.xy) / a2 + h.z * h.z;
    float D = 2.0 / (TAU * a2 * d * d);
    float visible = 2.0 * wo.z / (wo.z + sqrt(a2 + (1.0 - a2) * wo.z * wo.z));
    return mix(matte, D * visible / (4.0 * wo.z), lobe_share);
}

// A direction drawn by the stand-in: visible normals of GGX [Dupuy2023], or a cosine lobe.
vec3 lobe_direction(vec2 u, vec3 wo) {
    if (u.y >= lobe_share) {
        u.y = (u.y - lobe_share) / (1.0 - lobe_share);
        float side = TRANSMITS && u.y >= 0.5 ? -1.0 : 1.0;
        if (TRANSMITS) u.y = fract(2.0 * u.y);
        return vec3(sqrt(u.y) * vec2(cos(TAU * u.x), sin(TAU * u.x)), side * sqrt(1.0 - u.y));
    }
    vec3 stretched = normalize(vec3(lobe_alpha * wo.xy, wo.z));
    float z = (1.0 - u.y / lobe_share) * (1.0 + stretched.z) - stretched.z;
    vec3 h = vec3(sqrt(clamp(1.0 - z * z, 0.0, 1.0)) * vec2(cos(TAU * u.x), sin(TAU * u.x)), z) + stretched;
    h = normalize(vec3(lobe_alpha * h.xy, max(h.z, 1e-6)));
    return reflect(-wo, h);
}

vec3 weighed(Point point, vec3 wi, vec3 world, vec4 light, float density) {
    if (!reaches(wi) || !(density > 0.0)) return vec3(0.0);
    vec3 value = finite(MATERIAL(wi, point.wo, point.uv) * light.rgb * (COSINE(wi.z) / density));
    return value != vec3(0.0) && visible(point, wi, world, 1e30) ? value : vec3(0.0);
}

vec3 from_environment(Point point) {
    vec3 radiance = vec3(0.0);
    uvec2 pixel = uvec2(gl_FragCoord.x, picture_size.y - gl_FragCoord.y);
    uint seed = uint(environment_seed), total = uint(environment_total > 0 ? environment_total : MANY);
    uint samples = uint(max(environment_samples, 1)), place = along_curve(pixel, seed), pass = uint(environment_pass);
    // All pixels' passes of one number look at the same few strata; those of several numbers side by side, at all.
    if (environment_dealt) pass = (pass + hashed(place)) % (total / samples);
    uint first = place * total + pass * samples;
    for (int s = 0; s < environment_samples; s++) {
        ivec2 chosen = ivec2(sequence(first + uint(s), 2u * seed).yx * vec2(textureSize(environment_directions, 0)));
        vec3 world = environment_direction(texelFetch(environment_directions, chosen, 0).xy);
        vec3 wi = normalize(world * point.frame);
        for (int kind = 0; kind < 2; kind++) {  // a loop, for some drivers never finish with the same text twice
            if (kind == 1) {
                wi = lobe_direction(sequence(first + uint(s), 2u * seed + 1u), point.wo);
                world = point.frame * wi;
            }
            vec4 light = environment(world);
            radiance += weighed(point, wi, world, light, light.a + lobe_density(wi, point.wo));
        }
    }
    return radiance / float(samples);
}
