// Vectors of three numbers, in the world of the renderer: +y up, +x to the right, +z to the viewer.

/** @typedef {[number, number, number]} Vector */

export const RADIANS = Math.PI / 180;

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b */
export function dot(a, b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b @returns {Vector} */
export function cross(a, b) {
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

/** @param {ArrayLike<number>} a @param {ArrayLike<number>} b @param {number} scale @returns {Vector} a + scale b */
export function plus(a, b, scale = 1) {
    return [a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]];
}

/** @param {ArrayLike<number>} a @returns {Vector} */
export function unit(a) {
    const scale = 1 / (Math.hypot(a[0], a[1], a[2]) || 1);
    return [a[0] * scale, a[1] * scale, a[2] * scale];
}

/**
 * The unit vector `theta` degrees from +y, turned `phi` degrees from +z towards +x.
 * @param {number} theta
 * @param {number} phi
 * @returns {Vector}
 */
export function direction(theta, phi) {
    const t = theta * RADIANS;
    const p = phi * RADIANS;
    return [Math.sin(t) * Math.sin(p), Math.cos(t), Math.sin(t) * Math.cos(p)];
}

/**
 * (theta, phi) in degrees of a unit vector: the inverse of `direction`.
 * @param {ArrayLike<number>} d
 * @returns {[number, number]}
 */
export function angles(d) {
    return [Math.acos(Math.min(1, Math.max(-1, d[1]))) / RADIANS, Math.atan2(d[0], d[2]) / RADIANS];
}
