// How far one material is from another, by the package's protocol (see brdf.metrics): pictures of a lit sphere.

import { encode } from "./colour.js";
import { Directions } from "./evaluate.js";

/** Degrees between the direction to the light and to the viewer. */
const LIGHT_ANGLES = Array.from({ length: 36 }, (_, i) => 5 * i);

/** Pixels across the sphere's picture. */
export const SPHERE_SIZE = 128;

/** Compares materials again and again: the directions stay on the graphics card. */
export class Comparer {
    /**
     * @param {import("./evaluate.js").Evaluator} evaluator
     * @param {number} size pixels across; the protocol's own, or fewer to be quick
     */
    constructor(evaluator, size = SPHERE_SIZE) {
        this.evaluator = evaluator;
        const { wi, wo, cosines } = litPixels(size);
        this.cosines = cosines;
        this.pair = [new Directions(wi), new Directions(wo)];
    }

    /**
     * PSNR [dB] of all lights pooled; Infinity where the pictures are identical.
     * @param {import("./material.js").Material} reference
     * @param {import("./material.js").Material} other
     */
    psnr(reference, other) {
        const [wi, wo] = this.pair;
        const [a, b] = [reference, other].map((material) => this.evaluator.evaluate(material, wi, wo));
        let sum = 0;
        this.cosines.forEach((cosine, i) => {
            for (let n = 4 * i; n < 4 * i + 3; n++) sum += (encode(a[n] * cosine) - encode(b[n] * cosine)) ** 2;
        });
        return -10 * Math.log10(sum / (3 * this.cosines.length));
    }

    dispose() {
        for (const list of this.pair) this.evaluator.drop(list);
    }
}

/**
 * Local directions of all lit pixels, and pi times the cosine of the light: see brdf.metrics.sphere.sphere_pairs.
 * @param {number} size
 */
export function litPixels(size) {
    /** @type {number[][]} */
    const [wi, wo, cosines] = [[], [], []];
    for (const angle of LIGHT_ANGLES) {
        const [sine, cosine] = [Math.sin((angle * Math.PI) / 180), Math.cos((angle * Math.PI) / 180)];
        for (let row = 0; row < size; row++) {
            for (let column = 0; column < size; column++) {
                const [x, y] = [(2 * column + 1) / size - 1, (2 * row + 1) / size - 1];
                const z = Math.sqrt(1 - x * x - y * y);
                const lit = x * sine + z * cosine;
                if (!(z > 0 && lit > 0)) continue;
                const across = Math.hypot(x, z);  // the tangent is (z, 0, -x) of this length
                const up = [-x * y, x * x + z * z, -y * z].map((part) => part / across);
                wi.push((z * sine - x * cosine) / across, up[0] * sine + up[2] * cosine, lit, 0.5);
                wo.push(-x / across, up[2], z, 0.5);
                cosines.push(Math.PI * lit);
            }
        }
    }
    return { wi: new Float32Array(wi), wo: new Float32Array(wo), cosines: new Float64Array(cosines) };
}
