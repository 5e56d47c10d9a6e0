// Measurements on adaptive grids: the one evaluation that stands in Python, too (see brdf.representations.adaptive and
// adaptive_kernels, which explain it). Reference: Dupuy2018.

import { isFiniteList } from "./bytes.js";

/**
 * @typedef {import("./tensors.js").Tensor} Tensor
 *
 * Grids [ny, nx] over the unit square, one for each incident direction.
 * @typedef {{numbers: Float32Array, ny: number, nx: number}} Grids
 *
 * The same as densities, with their sums along x, and the sums of those along y.
 * @typedef {{density: Float32Array, conditional: Float32Array, marginal: Float32Array, ny: number, nx: number}} Warp
 *
 * Where an incident direction lies between the measured ones: four grids, and their weights.
 * @typedef {{grids: number[], weights: number[]}} Place
 */

export class Adaptive {
    /**
     * Throws an Error that names the field which is wrong.
     * @param {Map<string, Tensor>} tensors
     */
    constructor(tensors) {
        this.theta_i = nodes(tensors, "theta_i");
        this.phi_i = nodes(tensors, "phi_i");
        if (!tensors.has("rgb") && tensors.has("spectra")) {
            throw new Error("it holds spectra, which only Python makes colours of: brdf export FILE page.html");
        }
        const incident = [this.phi_i.length, this.theta_i.length];
        this.ndf = grids(tensors, "ndf", []);
        this.sigma = grids(tensors, "sigma", []);
        this.vndf = warp(grids(tensors, "vndf", incident));
        this.rgb = grids(tensors, "rgb", [...incident, 3], true);
        this.hasJacobian = Boolean(field(tensors, "jacobian").numbers.some(Boolean));
        if (!this.sigma.numbers.every((area) => area > 0)) {
            throw new Error("field 'sigma' must be above zero everywhere");
        }
        this.relative = this.phi_i.length <= 2;
        const span = this.phi_i[this.phi_i.length - 1] - this.phi_i[0];
        this.reduction = this.relative ? 1 : Math.round((2 * Math.PI) / span);
        if (![1, 2, 4].includes(this.reduction)) {
            throw new Error("field 'phi_i' must span the whole circle, a half or a quarter of it");
        }
    }

    get isotropic() {
        return this.phi_i.length === 1;
    }

    /** What Python's arrays of the same take. */
    get nbytes() {
        const { ndf, sigma, vndf, rgb } = this;
        return 4 * [ndf.numbers, sigma.numbers, vndf.density, rgb.numbers].reduce((sum, list) => sum + list.length, 0);
    }

    /**
     * f [1/sr], negative values kept, into `out`; zero below the horizon.
     * @param {number} ix @param {number} iy @param {number} iz to the light
     * @param {number} ox @param {number} oy @param {number} oz to the viewer
     * @param {Float64Array | number[]} out
     */
    evaluate(ix, iy, iz, ox, oy, oz, out) {
        out[0] = out[1] = out[2] = 0;
        if (!(iz > 0 && oz > 0)) return;
        if (this.reduction > 1) {
            const sy = iy > 0 ? -1 : 1;
            const sx = this.reduction === 4 ? (ix > 0 ? -1 : 1) : sy;
            [ix, iy, ox, oy] = [sx * ix, sy * iy, sx * ox, sy * oy];
        }
        const thetaI = Math.atan2(Math.hypot(ix, iy), iz), phiI = Math.atan2(iy, ix);
        const [mx, my, mz] = [ix + ox, iy + oy, iz + oz];
        const u = Math.sqrt(Math.atan2(Math.hypot(mx, my), mz) * (2 / Math.PI));
        let v = (Math.atan2(my, mx) - (this.relative ? phiI : 0)) / (2 * Math.PI) + 0.5;
        v -= Math.floor(v);
        const place = located(this.phi_i, this.theta_i, phiI, thetaI);
        const [x, y] = unwarped(this.vndf, place, u, v);
        let scale = 1 / oz;
        if (this.hasJacobian) {
            const [uI, vI] = [Math.sqrt(thetaI * (2 / Math.PI)), phiI / (2 * Math.PI) + 0.5];
            scale *= bilinear(this.ndf, 0, u, v) / (4 * bilinear(this.sigma, 0, uI, vI));
        }
        for (let n = 0; n < 4; n++) {
            const weight = scale * place.weights[n];
            if (!weight) continue;
            for (let c = 0; c < 3; c++) out[c] += weight * bilinear(this.rgb, 3 * place.grids[n] + c, x, y);
        }
    }
}

/**
 * The interval of increasing nodes that holds x, and the position in it.
 * @param {Float64Array} list
 * @param {number} x
 */
function bracket(list, x) {
    if (list.length === 1) return [0, 0];
    let low = 0, high = list.length - 1;
    while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (list[middle] <= x) low = middle;
        else high = middle;
    }
    return [low, Math.min(Math.max((x - list[low]) / (list[low + 1] - list[low]), 0), 1)];
}

/**
 * @param {Float64Array} phis
 * @param {Float64Array} thetas
 * @param {number} phi
 * @param {number} theta
 * @returns {Place}
 */
function located(phis, thetas, phi, theta) {
    const [p, fp] = bracket(phis, phi);
    const [t, ft] = bracket(thetas, theta);
    const first = p * thetas.length + t;
    return {
        grids: [first, first + 1, first + thetas.length, first + thetas.length + 1],
        weights: [(1 - fp) * (1 - ft), (1 - fp) * ft, fp * (1 - ft), fp * ft],
    };
}

/**
 * The patch of a grid's axis with so many nodes that holds x in [0, 1], and the position in it.
 * @param {number} x
 * @param {number} count
 */
function patch(x, count) {
    const index = Math.min(Math.max(Math.floor(x * (count - 1)), 0), count - 2);
    return [index, x * (count - 1) - index];
}

/**
 * @param {Grids} grids
 * @param {number} which
 * @param {number} x
 * @param {number} y
 */
function bilinear({ numbers, ny, nx }, which, x, y) {
    const [i, fx] = patch(x, nx);
    const [j, fy] = patch(y, ny);
    const n = (which * ny + j) * nx + i;
    const lower = (1 - fx) * numbers[n] + fx * numbers[n + 1];
    const upper = (1 - fx) * numbers[n + nx] + fx * numbers[n + nx + 1];
    return (1 - fy) * lower + fy * upper;
}

/**
 * @param {Grids} grids
 * @returns {Warp}
 */
function warp({ numbers, ny, nx }) {
    const count = numbers.length / (ny * nx);
    const density = new Float32Array(numbers.length);
    const conditional = new Float32Array(numbers.length);
    const marginal = new Float32Array(count * ny);
    const sums = new Float64Array(ny * nx);
    const rows = new Float64Array(ny);
    for (let n = 0; n < count; n++) {
        const start = n * ny * nx;
        let largest = 2 ** -126;
        for (let k = 0; k < ny * nx; k++) largest = Math.max(largest, numbers[start + k]);
        for (let j = 0; j < ny; j++) {
            for (let i = 1; i < nx; i++) {
                const k = j * nx + i;
                sums[k] = sums[k - 1] + (0.5 * (numbers[start + k] + numbers[start + k - 1])) / largest;
            }
            const row = (/** @type {number} */ j) => sums[j * nx + nx - 1];
            rows[j] = j ? rows[j - 1] + 0.5 * (row(j) + row(j - 1)) : 0;
        }
        const total = rows[ny - 1];
        if (!(total > 0)) throw new Error("field 'vndf' is zero everywhere for one of the incident directions");
        for (let k = 0; k < ny * nx; k++) {
            density[start + k] = numbers[start + k] / largest / total;
            conditional[start + k] = sums[k] / total;
        }
        for (let j = 0; j < ny; j++) marginal[n * ny + j] = rows[j] / total;
    }
    return { density, conditional, marginal, ny, nx };
}

/**
 * The number at `k` of each grid of `size`, between the incident directions.
 * @param {Float32Array} numbers
 * @param {number} size
 * @param {Place} place
 * @param {number} k
 */
function blended(numbers, size, { grids, weights }, k) {
    let sum = 0;
    for (let n = 0; n < 4; n++) if (weights[n]) sum += weights[n] * numbers[grids[n] * size + k];
    return sum;
}

/**
 * A place with the warp's density -> uniform numbers.
 * @param {Warp} warp
 * @param {Place} place
 * @param {number} x
 * @param {number} y
 */
function unwarped({ density, conditional, marginal, ny, nx }, place, x, y) {
    const [i, fx] = patch(x, nx);
    const [j, fy] = patch(y, ny);
    const at = (/** @type {Float32Array} */ numbers, /** @type {number} */ row, /** @type {number} */ column) =>
        blended(numbers, ny * nx, place, row * nx + column);
    const left = (1 - fy) * at(density, j, i) + fy * at(density, j + 1, i);
    const right = (1 - fy) * at(density, j, i + 1) + fy * at(density, j + 1, i + 1);
    const before = (1 - fy) * at(conditional, j, i) + fy * at(conditional, j + 1, i);
    const [row0, row1] = [at(conditional, j, nx - 1), at(conditional, j + 1, nx - 1)];
    const row = (1 - fy) * row0 + fy * row1;
    const ux = row > 0 ? (before + fx * (left + 0.5 * fx * (right - left))) / row : fx;
    const uy = blended(marginal, ny, place, j) + fy * (row0 + 0.5 * fy * (row1 - row0));
    return [ux, uy].map((number) => Math.min(Math.max(number, 0), 1));
}

/**
 * @param {Map<string, Tensor>} tensors
 * @param {string} name
 */
function field(tensors, name) {
    const found = tensors.get(name);
    if (!found) throw new Error(`field '${name}' is missing`);
    return found;
}

/**
 * A list of numbers that increase.
 * @param {Map<string, Tensor>} tensors
 * @param {string} name
 */
function nodes(tensors, name) {
    const { shape, numbers } = field(tensors, name);
    const list = Float64Array.from(numbers, Number);
    const increases = list.every((x, i) => i === 0 || x > list[i - 1]);
    if (shape.length !== 1 || !list.length || !isFiniteList(list) || !increases) {
        throw new Error(`field '${name}' must be a list of numbers that increase`);
    }
    return list;
}

/**
 * A field of grids, the `first` axes of which have the sizes given.
 * @param {Map<string, Tensor>} tensors
 * @param {string} name
 * @param {number[]} first
 * @returns {Grids}
 */
function grids(tensors, name, first, signed = false) {
    const { shape, numbers } = field(tensors, name);
    const [ny, nx] = shape.slice(-2);
    const isSingle = numbers instanceof Float32Array;
    if (!isSingle || String(shape.slice(0, -2)) !== String(first) || !(Math.min(ny, nx) >= 2)) {
        const [wanted, given] = [[...first, "n", "n"], shape].map((sizes) => sizes.join(" x "));
        const type = isSingle ? "float32" : "another type";
        throw new Error(`field '${name}' must be float32 ${wanted} with n >= 2, got ${type} ${given}`);
    }
    if (!isFiniteList(numbers)) throw new Error(`field '${name}' holds NaN or infinity`);
    if (!signed && numbers.some((/** @type {number} */ x) => x < 0)) {
        throw new Error(`field '${name}' holds negative values`);
    }
    return { numbers, ny, nx };
}
