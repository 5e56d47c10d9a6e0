// sRGB's curve.

/**
 * Linear to sRGB, clamped to [0, 1].
 * @param {number} x
 */
export function encode(x) {
    const y = Math.min(Math.max(x, 0), 1);
    return y <= 0.0031308 ? 12.92 * y : 1.055 * y ** (1 / 2.4) - 0.055;
}

/** @param {number} y sRGB in [0, 1] */
export function linear(y) {
    return y <= 0.04045 ? y / 12.92 : ((y + 0.055) / 1.055) ** 2.4;
}
