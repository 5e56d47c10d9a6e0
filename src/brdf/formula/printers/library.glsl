// x^y for x >= 0, 0^y included, which pow leaves open.
float power(float x, float y) { return x > 0.0 ? pow(x, y) : y > 0.0 ? 0.0 : pow(1e-38, y); }

vec3 power3(vec3 x, vec3 y) { return vec3(power(x.x, y.x), power(x.y, y.y), power(x.z, y.z)); }

// Inverse trigonometric functions to 4e-7: what drivers have is off by up to 4e-4.
float arcsine_over_argument(float z) {
    return 1.0 + z * (0.16666787 + z * (0.074945343 + z * (0.04553901 + z * (0.023909364 + z * 0.042553599))));
}

float arcsin(float x) {
    float magnitude = min(abs(x), 1.0);
    bool is_large = magnitude > 0.5;
    float z = is_large ? 0.5 * (1.0 - magnitude) : magnitude * magnitude;
    float angle = (is_large ? sqrt(z) : magnitude) * arcsine_over_argument(z);
    angle = is_large ? 1.5707964 - 2.0 * angle : angle;
    return x < 0.0 ? -angle : angle;
}

vec3 arcsin3(vec3 x) { return vec3(arcsin(x.x), arcsin(x.y), arcsin(x.z)); }

float arccos(float x) {
    float magnitude = min(abs(x), 1.0);
    bool is_large = magnitude > 0.5;
    float z = is_large ? 0.5 * (1.0 - magnitude) : magnitude * magnitude;
    float angle = (is_large ? sqrt(z) : magnitude) * arcsine_over_argument(z);
    if (is_large) return x < 0.0 ? 3.1415927 - 2.0 * angle : 2.0 * angle;
    return 1.5707964 - (x < 0.0 ? -angle : angle);
}

vec3 arccos3(vec3 x) { return vec3(arccos(x.x), arccos(x.y), arccos(x.z)); }

float arctan2(float y, float x) {
    float across = abs(y), along = abs(x), large = max(across, along), small = min(across, along);
    bool near_diagonal = small > 0.41421356 * large;
    float t = (near_diagonal ? small - large : small) / max(near_diagonal ? small + large : large, 1e-37);
    float z = t * t;
    float angle = t * (1.0 + z * (-0.33332797 + z * (0.19974394 + z * (-0.1385136 + z * 0.079845696))));
    angle = near_diagonal ? angle + 0.78539819 : angle;
    angle = across > along ? 1.5707964 - angle : angle;
    angle = x < 0.0 ? 3.1415927 - angle : angle;
    return y < 0.0 ? -angle : angle;
}

vec3 arctan23(vec3 y, vec3 x) { return vec3(arctan2(y.x, x.x), arctan2(y.y, x.y), arctan2(y.z, x.z)); }

float arctan(float x) { return arctan2(x, 1.0); }

vec3 arctan3(vec3 x) { return vec3(arctan(x.x), arctan(x.y), arctan(x.z)); }

// Gauss error function to 4e-7.
float erf(float x) {
    float a = min(abs(x), 4.2), z = a * a, t = 1.0 / (1.0 + 0.5 * a);
    float inner = a * (1.1283792 + z * (-0.37612638 + z * (0.11283782 + z * (-0.026865438 + z * (0.0052210534
        + z * (-0.00084843965 + z * (0.00011268254 + z * -9.6735905e-06)))))));
    float outer = 1.0 - exp(-z) * (0.00053877058 + t * (0.27445547 + t * (0.32657172 + t * (0.11274845
        + t * (0.38665777 + t * (-0.043767178 + t * -0.057963364))))));
    float value = a < 1.0 ? inner : outer;
    return x < 0.0 ? -value : value;
}

vec3 erf3(vec3 x) { return vec3(erf(x.x), erf(x.y), erf(x.z)); }

// Where u lies among the texels, whose centres are at (i + 0.5) / size; the edge texel extends outward.
// u runs over the axes of the table, the first of which is the last of the texture.
vec2 position2(sampler2D t, vec2 u) {
    vec2 size = vec2(textureSize(t, 0));
    return clamp(u.yx * size - 0.5, vec2(0.0), size - 1.0);
}

// Where u lies among the texels, whose centres are at (i + 0.5) / size; the edge texel extends outward.
// u runs over the axes of the table, the first of which is the last of the texture.
vec3 position3(sampler3D t, vec3 u) {
    vec3 size = vec3(textureSize(t, 0));
    return clamp(u.zyx * size - 0.5, vec3(0.0), size - 1.0);
}

// Texel i by its centre, of a texture with the filter NEAREST. With texelFetch, for which llvmpipe looks up the mip
// level of every pixel, frames of tables took a fifth longer.
vec4 texel2(sampler2D t, ivec2 i) { return textureLod(t, (vec2(i) + 0.5) / vec2(textureSize(t, 0)), 0.0); }

// Texel i by its centre, of a texture with the filter NEAREST. With texelFetch, for which llvmpipe looks up the mip
// level of every pixel, frames of tables took a fifth longer.
vec4 texel3(sampler3D t, ivec3 i) { return textureLod(t, (vec3(i) + 0.5) / vec3(textureSize(t, 0)), 0.0); }

vec4 nearest2(sampler2D t, vec2 u) { return texel2(t, ivec2(position2(t, u) + 0.5)); }

vec4 nearest3(sampler3D t, vec3 u) { return texel3(t, ivec3(position3(t, u) + 0.5)); }

// In single precision, of any format; HARDWARE_FILTER leaves it to the hardware: faster and, on most, coarser.
vec4 linear2(sampler2D t, vec2 u) {
#ifdef HARDWARE_FILTER
    return textureLod(t, u.yx, 0.0);
#else
    vec2 x = position2(t, u);
    ivec2 last = textureSize(t, 0) - 1, i = min(ivec2(x), max(last - 1, 0)), j = min(i + 1, last);
    vec2 f = x - vec2(i);
    return mix(mix(texel2(t, i), texel2(t, ivec2(j.x, i.y)), f.x),
               mix(texel2(t, ivec2(i.x, j.y)), texel2(t, j), f.x), f.y);
#endif
}

// In single precision, of any format; HARDWARE_FILTER leaves it to the hardware: faster and, on most, coarser.
vec4 linear3(sampler3D t, vec3 u) {
#ifdef HARDWARE_FILTER
    return textureLod(t, u.zyx, 0.0);
#else
    vec3 x = position3(t, u);
    ivec3 last = textureSize(t, 0) - 1, i = min(ivec3(x), max(last - 1, 0)), j = min(i + 1, last);
    vec3 f = x - vec3(i);
    vec4 near = mix(mix(texel3(t, i), texel3(t, ivec3(j.x, i.yz)), f.x),
                    mix(texel3(t, ivec3(i.x, j.y, i.z)), texel3(t, ivec3(j.xy, i.z)), f.x), f.y);
    vec4 far = mix(mix(texel3(t, ivec3(i.xy, j.z)), texel3(t, ivec3(j.x, i.y, j.z)), f.x),
                   mix(texel3(t, ivec3(i.x, j.yz)), texel3(t, j), f.x), f.y);
    return mix(near, far, f.z);
#endif
}

// The weights of the texels at -1, 0, 1, 2.
vec4 catmull_rom_weights(float x) {
    return vec4(((1.0 - 0.5 * x) * x - 0.5) * x, (1.5 * x - 2.5) * x * x + 1.0, ((2.0 - 1.5 * x) * x + 0.5) * x,
                (0.5 * x - 0.5) * x * x);
}

vec4 b_spline_weights(float x) {
    float y = 1.0 - x;
    return vec4(y * y * y / 6.0, (0.5 * x - 1.0) * x * x + 0.66666667, (0.5 * y - 1.0) * y * y + 0.66666667,
                x * x * x / 6.0);
}

// Cubic filters see the texels before an edge mirrored beyond it.
int mirrored(int i, int size) { return clamp(min(abs(i), 2 * (size - 1) - abs(i)), 0, size - 1); }

vec4 cubic2(sampler2D t, ivec2 i, vec4 x_weights, vec4 y_weights) {
    ivec2 size = textureSize(t, 0);
    vec4 sum = vec4(0.0);
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 4; x++)
            sum += x_weights[x] * y_weights[y]
                * texel2(t, ivec2(mirrored(i.x + x - 1, size.x), mirrored(i.y + y - 1, size.y)));
    return sum;
}

vec4 cubic3(sampler3D t, ivec3 i, vec4 x_weights, vec4 y_weights, vec4 z_weights) {
    ivec3 size = textureSize(t, 0);
    vec4 sum = vec4(0.0);
    for (int z = 0; z < 4; z++)
        for (int y = 0; y < 4; y++)
            for (int x = 0; x < 4; x++)
                sum += x_weights[x] * y_weights[y] * z_weights[z]
                    * texel3(t, ivec3(mirrored(i.x + x - 1, size.x), mirrored(i.y + y - 1, size.y),
                                       mirrored(i.z + z - 1, size.z)));
    return sum;
}

vec4 catmull_rom2(sampler2D t, vec2 u) {
    vec2 x = position2(t, u);
    ivec2 i = min(ivec2(x), max(textureSize(t, 0) - 2, 0));
    vec2 f = x - vec2(i);
    return cubic2(t, i, catmull_rom_weights(f.x), catmull_rom_weights(f.y));
}

vec4 catmull_rom3(sampler3D t, vec3 u) {
    vec3 x = position3(t, u);
    ivec3 i = min(ivec3(x), max(textureSize(t, 0) - 2, 0));
    vec3 f = x - vec3(i);
    return cubic3(t, i, catmull_rom_weights(f.x), catmull_rom_weights(f.y), catmull_rom_weights(f.z));
}

vec4 b_spline2(sampler2D t, vec2 u) {
    vec2 x = position2(t, u);
    ivec2 i = min(ivec2(x), max(textureSize(t, 0) - 2, 0));
    vec2 f = x - vec2(i);
    return cubic2(t, i, b_spline_weights(f.x), b_spline_weights(f.y));
}

vec4 b_spline3(sampler3D t, vec3 u) {
    vec3 x = position3(t, u);
    ivec3 i = min(ivec3(x), max(textureSize(t, 0) - 2, 0));
    vec3 f = x - vec3(i);
    return cubic3(t, i, b_spline_weights(f.x), b_spline_weights(f.y), b_spline_weights(f.z));
}
