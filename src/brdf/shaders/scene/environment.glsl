// Light from all around, estimated with two kinds of directions at once, weighed by the balance heuristic [Veach1995]:
// by the environment's brightness, and by a lobe that stands in for the reflectance (GGX and a diffuse one).

uniform int environment_samples;           // a pass and kind; 0: there is no environment
uniform int environment_pass;              // 0, 1, 2, ...: passes draw other directions
uniform int environment_seed;
uniform sampler2D environment_map;         // radiance, and density of the brightness over solid angle [1/sr]
uniform sampler2D environment_directions;  // a list of places (u, v) in the map, drawn by brightness
uniform vec2 environment_turn;             // cosine and sine of the rotation about +y
uniform float environment_scale;           // of the radiance
uniform float lobe_alpha, lobe_share;      // width and probability of the stand-in's GGX lobe

const float TAU = 6.28318531;

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
    vec2 place = vec2(atan(turned.x, -turned.y) / TAU + 0.5, acos(clamp(d.y, -1.0, 1.0)) / TAU * 2.0) * size;
    float density = environment_texel(min(ivec2(place), ivec2(size) - 1)).a;
    vec2 corner = floor(place - 0.5), f = place - 0.5 - corner;
    ivec2 i = ivec2(corner);
    vec3 upper = mix(environment_texel(i).rgb, environment_texel(i + ivec2(1, 0)).rgb, f.x);
    vec3 lower = mix(environment_texel(i + ivec2(0, 1)).rgb, environment_texel(i + ivec2(1, 1)).rgb, f.x);
    return vec4(mix(upper, lower, f.y) * environment_scale, density);
}

// Three numbers in [0, 1) for sample n of the pixel: a sequence of low discrepancy, shifted from pixel to pixel.
vec3 numbers(int n) {
    uvec3 v = uvec3(gl_FragCoord.xy, environment_seed) * 1664525u + 1013904223u;  // pcg3d [Jarzynski2020]
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;
    uvec3 steps = uvec3(3518319155u, 2882110345u, 2360945575u);  // 2^32 times the powers of 1 / 1.2207441
    return vec3((v + uint(n) * steps) >> 8u) * exp2(-24.0);
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
vec3 lobe_direction(vec3 u, vec3 wo) {
    float phi = TAU * u.x;
    if (u.z >= lobe_share) {
        float below = TRANSMITS && fract((u.z - lobe_share) / (1.0 - lobe_share) * 2.0) < 0.5 ? -1.0 : 1.0;
        return vec3(sqrt(u.y) * vec2(cos(phi), sin(phi)), below * sqrt(1.0 - u.y));
    }
    vec3 stretched = normalize(vec3(lobe_alpha * wo.xy, wo.z));
    float z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
    vec3 h = vec3(sqrt(clamp(1.0 - z * z, 0.0, 1.0)) * vec2(cos(phi), sin(phi)), z) + stretched;
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
    int directions = textureSize(environment_directions, 0).x * textureSize(environment_directions, 0).y;
    for (int s = 0; s < environment_samples; s++) {
        vec3 u = numbers(environment_pass * environment_samples + s);
        vec3 world = environment_direction(mesh_texel(environment_directions, int(u.x * float(directions))).xy);
        vec4 light = environment(world);
        vec3 wi = normalize(world * point.frame);
        radiance += weighed(point, wi, world, light, light.a + lobe_density(wi, point.wo));
        wi = lobe_direction(u.yzx, point.wo);
        world = point.frame * wi;
        light = environment(world);
        radiance += weighed(point, wi, world, light, light.a + lobe_density(wi, point.wo));
    }
    return radiance / float(max(environment_samples, 1));
}
