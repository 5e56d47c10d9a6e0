// x^y for x >= 0, 0^y included, which pow leaves open.
fn power(x: f32, y: f32) -> f32 {
    if (x > 0.0) { return pow(x, y); }
    if (y > 0.0) { return 0.0; }
    return pow(1e-38, y);
}

fn power3(x: vec3f, y: vec3f) -> vec3f { return vec3f(power(x.x, y.x), power(x.y, y.y), power(x.z, y.z)); }

// Inverse trigonometric functions to 4e-7: what drivers have is off by up to 4e-4.
fn arcsine_over_argument(z: f32) -> f32 {
    return 1.0 + z * (0.16666787 + z * (0.074945343 + z * (0.04553901 + z * (0.023909364 + z * 0.042553599))));
}

fn arcsin(x: f32) -> f32 {
    let magnitude = min(abs(x), 1.0);
    let is_large = magnitude > 0.5;
    let z = select(magnitude * magnitude, 0.5 * (1.0 - magnitude), is_large);
    let reduced = select(magnitude, sqrt(z), is_large) * arcsine_over_argument(z);
    let angle = select(reduced, 1.5707964 - 2.0 * reduced, is_large);
    return select(angle, -angle, x < 0.0);
}

fn arcsin3(x: vec3f) -> vec3f { return vec3f(arcsin(x.x), arcsin(x.y), arcsin(x.z)); }

fn arccos(x: f32) -> f32 {
    let magnitude = min(abs(x), 1.0);
    let is_large = magnitude > 0.5;
    let z = select(magnitude * magnitude, 0.5 * (1.0 - magnitude), is_large);
    let angle = select(magnitude, sqrt(z), is_large) * arcsine_over_argument(z);
    if (is_large) { return select(2.0 * angle, 3.1415927 - 2.0 * angle, x < 0.0); }
    return 1.5707964 - select(angle, -angle, x < 0.0);
}

fn arccos3(x: vec3f) -> vec3f { return vec3f(arccos(x.x), arccos(x.y), arccos(x.z)); }

fn arctan2(y: f32, x: f32) -> f32 {
    let across = abs(y);
    let along = abs(x);
    let large = max(across, along);
    let small = min(across, along);
    let near_diagonal = small > 0.41421356 * large;
    let t = select(small, small - large, near_diagonal) / max(select(large, small + large, near_diagonal), 1e-37);
    let z = t * t;
    var angle = t * (1.0 + z * (-0.33332797 + z * (0.19974394 + z * (-0.1385136 + z * 0.079845696))));
    angle = select(angle, angle + 0.78539819, near_diagonal);
    angle = select(angle, 1.5707964 - angle, across > along);
    angle = select(angle, 3.1415927 - angle, x < 0.0);
    return select(angle, -angle, y < 0.0);
}

fn arctan23(y: vec3f, x: vec3f) -> vec3f { return vec3f(arctan2(y.x, x.x), arctan2(y.y, x.y), arctan2(y.z, x.z)); }

fn arctan(x: f32) -> f32 { return arctan2(x, 1.0); }

fn arctan3(x: vec3f) -> vec3f { return vec3f(arctan(x.x), arctan(x.y), arctan(x.z)); }

// Gauss error function to 4e-7.
fn erf(x: f32) -> f32 {
    let a = min(abs(x), 4.2);
    let z = a * a;
    let t = 1.0 / (1.0 + 0.5 * a);
    let inner = a * (1.1283792 + z * (-0.37612638 + z * (0.11283782 + z * (-0.026865438 + z * (0.0052210534
        + z * (-0.00084843965 + z * (0.00011268254 + z * -9.6735905e-06)))))));
    let outer = 1.0 - exp(-z) * (0.00053877058 + t * (0.27445547 + t * (0.32657172 + t * (0.11274845
        + t * (0.38665777 + t * (-0.043767178 + t * -0.057963364))))));
    let value = select(outer, inner, a < 1.0);
    return select(value, -value, x < 0.0);
}

fn erf3(x: vec3f) -> vec3f { return vec3f(erf(x.x), erf(x.y), erf(x.z)); }

// Where u lies among the texels, whose centres are at (i + 0.5) / size; the edge texel extends outward.
// u runs over the axes of the table, the first of which is the last of the texture.
fn position2(t: texture_2d<f32>, u: vec2f) -> vec2f {
    let size = vec2f(textureDimensions(t));
    return clamp(u.yx * size - 0.5, vec2f(0.0), size - 1.0);
}

// Where u lies among the texels, whose centres are at (i + 0.5) / size; the edge texel extends outward.
// u runs over the axes of the table, the first of which is the last of the texture.
fn position3(t: texture_3d<f32>, u: vec3f) -> vec3f {
    let size = vec3f(textureDimensions(t));
    return clamp(u.zyx * size - 0.5, vec3f(0.0), size - 1.0);
}

fn nearest2(t: texture_2d<f32>, u: vec2f) -> vec4f { return textureLoad(t, vec2i(position2(t, u) + 0.5), 0); }

fn nearest3(t: texture_3d<f32>, u: vec3f) -> vec4f { return textureLoad(t, vec3i(position3(t, u) + 0.5), 0); }

fn linear2(t: texture_2d<f32>, u: vec2f) -> vec4f {
    let x = position2(t, u);
    let last = vec2i(textureDimensions(t)) - 1;
    let i = min(vec2i(x), max(last - 1, vec2i(0)));
    let j = min(i + 1, last);
    let f = x - vec2f(i);
    return mix(mix(textureLoad(t, i, 0), textureLoad(t, vec2i(j.x, i.y), 0), f.x),
               mix(textureLoad(t, vec2i(i.x, j.y), 0), textureLoad(t, j, 0), f.x), f.y);
}

fn linear3(t: texture_3d<f32>, u: vec3f) -> vec4f {
    let x = position3(t, u);
    let last = vec3i(textureDimensions(t)) - 1;
    let i = min(vec3i(x), max(last - 1, vec3i(0)));
    let j = min(i + 1, last);
    let f = x - vec3f(i);
    let near = mix(mix(textureLoad(t, i, 0), textureLoad(t, vec3i(j.x, i.yz), 0), f.x),
                   mix(textureLoad(t, vec3i(i.x, j.y, i.z), 0), textureLoad(t, vec3i(j.xy, i.z), 0), f.x), f.y);
    let far = mix(mix(textureLoad(t, vec3i(i.xy, j.z), 0), textureLoad(t, vec3i(j.x, i.y, j.z), 0), f.x),
                  mix(textureLoad(t, vec3i(i.x, j.yz), 0), textureLoad(t, j, 0), f.x), f.y);
    return mix(near, far, f.z);
}

// The weights of the texels at -1, 0, 1, 2.
fn catmull_rom_weights(x: f32) -> vec4f {
    return vec4f(((1.0 - 0.5 * x) * x - 0.5) * x, (1.5 * x - 2.5) * x * x + 1.0, ((2.0 - 1.5 * x) * x + 0.5) * x,
                 (0.5 * x - 0.5) * x * x);
}

fn b_spline_weights(x: f32) -> vec4f {
    let y = 1.0 - x;
    return vec4f(y * y * y / 6.0, (0.5 * x - 1.0) * x * x + 0.66666667, (0.5 * y - 1.0) * y * y + 0.66666667,
                 x * x * x / 6.0);
}

// Cubic filters see the texels before an edge mirrored beyond it.
fn mirrored(i: i32, size: i32) -> i32 { return clamp(min(abs(i), 2 * (size - 1) - abs(i)), 0, size - 1); }

fn cubic2(t: texture_2d<f32>, i: vec2i, x_weights: vec4f, y_weights: vec4f) -> vec4f {
    let size = vec2i(textureDimensions(t));
    var sum = vec4f(0.0);
    for (var y = 0; y < 4; y++) {
        for (var x = 0; x < 4; x++) {
            let place = vec2i(mirrored(i.x + x - 1, size.x), mirrored(i.y + y - 1, size.y));
            sum += x_weights[x] * y_weights[y] * textureLoad(t, place, 0);
        }
    }
    return sum;
}

fn cubic3(t: texture_3d<f32>, i: vec3i, x_weights: vec4f, y_weights: vec4f, z_weights: vec4f) -> vec4f {
    let size = vec3i(textureDimensions(t));
    var sum = vec4f(0.0);
    for (var z = 0; z < 4; z++) {
        for (var y = 0; y < 4; y++) {
            for (var x = 0; x < 4; x++) {
                let place = vec3i(mirrored(i.x + x - 1, size.x), mirrored(i.y + y - 1, size.y),
                                  mirrored(i.z + z - 1, size.z));
                sum += x_weights[x] * y_weights[y] * z_weights[z] * textureLoad(t, place, 0);
            }
        }
    }
    return sum;
}

fn catmull_rom2(t: texture_2d<f32>, u: vec2f) -> vec4f {
    let x = position2(t, u);
    let i = min(vec2i(x), max(vec2i(textureDimensions(t)) - 2, vec2i(0)));
    let f = x - vec2f(i);
    return cubic2(t, i, catmull_rom_weights(f.x), catmull_rom_weights(f.y));
}

fn catmull_rom3(t: texture_3d<f32>, u: vec3f) -> vec4f {
    let x = position3(t, u);
    let i = min(vec3i(x), max(vec3i(textureDimensions(t)) - 2, vec3i(0)));
    let f = x - vec3f(i);
    return cubic3(t, i, catmull_rom_weights(f.x), catmull_rom_weights(f.y), catmull_rom_weights(f.z));
}

fn b_spline2(t: texture_2d<f32>, u: vec2f) -> vec4f {
    let x = position2(t, u);
    let i = min(vec2i(x), max(vec2i(textureDimensions(t)) - 2, vec2i(0)));
    let f = x - vec2f(i);
    return cubic2(t, i, b_spline_weights(f.x), b_spline_weights(f.y));
}

fn b_spline3(t: texture_3d<f32>, u: vec3f) -> vec4f {
    let x = position3(t, u);
    let i = min(vec3i(x), max(vec3i(textureDimensions(t)) - 2, vec3i(0)));
    let f = x - vec3f(i);
    return cubic3(t, i, b_spline_weights(f.x), b_spline_weights(f.y), b_spline_weights(f.z));
}
