// Directions to evaluate materials at, and what is made of the values.

/**
 * @typedef {import("../material.js").Material} Material
 * @typedef {import("../evaluate.js").Evaluator} Evaluator
 */

export const DEGREE = Math.PI / 180;

/** Where what varies over a surface is looked at. */
const MIDDLE = 0.5;

/** A list of pairs of directions that grows. */
export class Pairs {
    /** @param {number} most pairs */
    constructor(most) {
        this.wi = new Float32Array(4 * most);
        this.wo = new Float32Array(4 * most);
        this.count = 0;
    }

    /**
     * @param {ArrayLike<number>} wi
     * @param {ArrayLike<number>} wo
     */
    add(wi, wo) {
        for (const [list, w] of /** @type {const} */ ([[this.wi, wi], [this.wo, wo]])) {
            list.set([w[0], w[1], w[2], MIDDLE], 4 * this.count);
        }
        this.count++;
    }

    /**
     * f [1/sr] of the pairs, RGBA.
     * @param {Evaluator} evaluator
     * @param {Material} material
     */
    values(evaluator, material) {
        const end = 4 * this.count;
        return evaluator.evaluate(material, this.wi.subarray(0, end), this.wo.subarray(0, end));
    }
}

/**
 * @param {number} theta radians from the normal
 * @param {number} phi radians
 */
export function spherical(theta, phi) {
    return [Math.sin(theta) * Math.cos(phi), Math.sin(theta) * Math.sin(phi), Math.cos(theta)];
}

/**
 * Light and viewer of half and difference angles [rad]; not all of them are above the horizon.
 * @param {number} thetaH
 * @param {number} thetaD
 * @param {number} phiD
 */
export function fromHalf(thetaH, thetaD, phiD) {
    const [sh, ch, sd, cd] = [Math.sin(thetaH), Math.cos(thetaH), Math.sin(thetaD), Math.cos(thetaD)];
    const across = sd * Math.cos(phiD);
    const [h, d] = [[cd * sh, 0, cd * ch], [across * ch, sd * Math.sin(phiD), -across * sh]];
    return [h.map((x, i) => x + d[i]), h.map((x, i) => x - d[i])];
}

/**
 * Luminance of each pixel of RGBA.
 * @param {Float32Array} values
 */
export function luminances(values) {
    const found = new Float64Array(values.length / 4);
    for (let i = 0; i < found.length; i++) {
        found[i] = 0.2126 * values[4 * i] + 0.7152 * values[4 * i + 1] + 0.0722 * values[4 * i + 2];
    }
    return found;
}

/**
 * One channel of RGBA.
 * @param {Float32Array} values
 * @param {number} channel
 */
export function channelOf(values, channel) {
    return Float64Array.from({ length: values.length / 4 }, (_, i) => values[4 * i + channel]);
}

/**
 * Powers of ten that an axis runs between: from just above the largest value down, `most` decades at most.
 * @param {ArrayLike<number>[]} lists
 * @param {number} most
 */
export function decades(lists, most) {
    let [least, largest] = [Infinity, 0];
    for (const list of lists) {
        for (let i = 0; i < list.length; i++) {
            if (!(list[i] > 0 && list[i] < Infinity)) continue;
            least = Math.min(least, list[i]);
            largest = Math.max(largest, list[i]);
        }
    }
    if (!largest) return { low: -2, high: 0 };
    const high = Math.log10(largest) + 0.1;
    const low = Math.max(Math.floor(Math.log10(least)), Math.floor(high) - most);
    return { low: Math.min(low, Math.floor(high) - 2), high };
}

/**
 * Powers of ten from 10^`low` on, every `step`, as marks of an axis.
 * @param {number} low whole
 * @param {number} high
 */
export function powers(low, high, step = 1) {
    return Array.from({ length: Math.floor((high - low) / step) + 1 }, (_, i) => {
        return { at: 10 ** (low + step * i), text: `10${superscript(low + step * i)}` };
    });
}

/**
 * Round numbers from 0 up to what holds all values.
 * @param {number} largest
 * @param {number} count about how many
 */
export function ticks(largest, count = 4) {
    if (!(largest > 0)) return [0, 1];
    const rough = largest / count;
    const power = 10 ** Math.floor(Math.log10(rough));
    const step = power * /** @type {number} */ ([1, 2, 2.5, 5, 10].find((k) => k * power >= rough * 0.999));
    return Array.from({ length: Math.ceil(largest / step - 1e-9) + 1 }, (_, i) => i * step);
}

/**
 * f in the plane of incidence, for light from the left at `angle` [degrees], at each of `views` [degrees].
 * @param {Evaluator} evaluator
 * @param {Material} material
 * @param {number} angle
 * @param {ArrayLike<number>} views
 */
export function inPlane(evaluator, material, angle, views) {
    const pairs = new Pairs(views.length);
    const wi = spherical(-angle * DEGREE, 0);
    for (let i = 0; i < views.length; i++) pairs.add(wi, spherical(views[i] * DEGREE, 0));
    return pairs.values(evaluator, material);
}

/** Viewing angles [degrees] close enough for narrow lobes. */
export const SEEN = Float64Array.from({ length: 1799 }, (_, i) => (i - 899) / 10);

/**
 * A number for people, three digits.
 * @param {number} value
 */
export function short(value) {
    if (!Number.isFinite(value)) return value > 0 ? "∞" : "–";
    const size = Math.abs(value);
    if (size && (size < 1e-3 || size >= 1e4)) {
        const [digits, power] = value.toExponential(1).split("e");
        return `${digits}·10${superscript(Number(power))}`;
    }
    return String(Number(value.toPrecision(3)));
}

/** @param {number} whole */
function superscript(whole) {
    return String(whole).replace(/./g, (c) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(c)]);
}
