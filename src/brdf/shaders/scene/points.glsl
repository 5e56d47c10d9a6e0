// Sample points as brdf.render.points: one scrambled Sobol sequence, dealt out to the pixels along a space-filling curve
// [Ahmed2020, Burley2020].

uint hashed(uint x) {
    x = (x ^ x >> 16u) * 0x7FEB352Du;
    x = (x ^ x >> 15u) * 0x846CA68Bu;
    return x ^ x >> 16u;
}

uint reversed(uint x) {
    x = x >> 16u | x << 16u;
    x = (x & 0xFF00FF00u) >> 8u | (x & 0x00FF00FFu) << 8u;
    x = (x & 0xF0F0F0F0u) >> 4u | (x & 0x0F0F0F0Fu) << 4u;
    x = (x & 0xCCCCCCCCu) >> 2u | (x & 0x33333333u) << 2u;
    return (x & 0xAAAAAAAAu) >> 1u | (x & 0x55555555u) << 1u;
}

uint scrambled_reverse(uint x, uint seed) {
    x += seed;
    x ^= x * 0x6C50B47Cu;
    x ^= x * 0xB82F1E52u;
    x ^= x * 0xC7AFE638u;
    return x ^ x * 0x8D22F6E6u;
}

uint sobol_second(uint index) {
    uint result = 0u;
    for (uint column = 0x80000000u; index != 0u; index >>= 1u) {
        if ((index & 1u) != 0u) result ^= column;
        column ^= column >> 1u;
    }
    return result;
}

// Where a pixel, counted from the top left corner, comes along the curve.
uint along_curve(uvec2 pixel, uint seed) {
    uint position = 0u;
    for (int bit = 12; bit >= 0; bit--) {
        uvec2 digits = pixel >> uint(bit) & 1u;
        uint shuffle = hashed(position ^ seed + 0x9E3779B9u * uint(bit + 1));
        position = position << 2u | ((digits.x | digits.y << 1u) ^ (shuffle & 3u));
    }
    return position;
}

// Point number `at` in [0, 1) of the sequence.
vec2 sequence(uint at, uint seed) {
    uint first = reversed(scrambled_reverse(at, hashed(seed)));
    uint second = reversed(scrambled_reverse(reversed(sobol_second(at)), hashed(seed + 0x68BC21EBu)));
    return vec2(first >> 8u, second >> 8u) * exp2(-24.0);
}
