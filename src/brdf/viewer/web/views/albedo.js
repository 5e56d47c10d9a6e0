// Directional albedo over the angle of incidence.

import { DEGREE, Pairs, short, spherical, ticks } from "./numbers.js";
import { axes, curve, heightOf, rule } from "./plot.js";
import { curvesOf, curveView } from "./view.js";

/** Degrees from the normal. */
const VIEW_ANGLES = [...Array.from({ length: 17 }, (_, i) => 5 * i), 83, 86, 88];

/** Half vectors: their zenith angles crowd at the normal, as a power of even steps, and so do narrow lobes. */
const [ZENITHS, AZIMUTHS, POWER] = [96, 32, 3];

/**
 * Directional albedos as RGBA, by a midpoint rule over the half vector: d wi = 4 (wo . h) dh. What is transmitted and
 * what delta distributions mirror does not count.
 * @param {import("./numbers.js").Evaluator} evaluator
 * @param {import("./numbers.js").Material} material
 * @param {number[]} angles degrees from the normal
 */
export function albedos(evaluator, material, angles) {
    const isotropic = material.source.isotropic ?? false;
    const turns = isotropic ? AZIMUTHS : 2 * AZIMUTHS;  // of what is isotropic half the circle says all
    const pairs = new Pairs(ZENITHS * turns * angles.length);
    /** @type {[number, number][]} the angle's index, the weight */
    const weights = [];
    const halves = halfVectors(turns, isotropic ? Math.PI : 2 * Math.PI);
    angles.forEach((angle, index) => {
        const wo = spherical(angle * DEGREE, 0);
        for (const { h, area } of halves) {
            const cosine = h[0] * wo[0] + h[2] * wo[2];
            const wi = h.map((part, i) => 2 * cosine * part - wo[i]);
            if (!(cosine > 0 && wi[2] > 0)) continue;
            pairs.add(wi, wo);
            weights.push([index, 4 * cosine * area * wi[2]]);
        }
    });
    const values = pairs.values(evaluator, material);
    const sums = new Float64Array(4 * angles.length);
    weights.forEach(([index, weight], n) => {
        for (let c = 0; c < 3; c++) sums[4 * index + c] += weight * values[4 * n + c];
    });
    return new Float32Array(sums);
}

/**
 * Half vectors over a part of the circle, and the solid angle that each stands for, all of the hemisphere together.
 * @param {number} turns
 * @param {number} extent
 */
function halfVectors(turns, extent) {
    const found = [];
    for (let i = 0; i < ZENITHS; i++) {
        const u = (i + 0.5) / ZENITHS;
        const theta = (u ** POWER * Math.PI) / 2;
        const step = (POWER * u ** (POWER - 1) * Math.PI) / 2 / ZENITHS;
        for (let k = 0; k < turns; k++) {
            const h = spherical(theta, ((k + 0.5) / turns) * extent);
            found.push({ h, area: Math.sin(theta) * step * ((2 * Math.PI) / turns) });
        }
    }
    return found;
}

export const albedo = curveView({
    id: "albedo",
    title: "Albedo",
    series({ evaluator }, materials, names) {
        return curvesOf(names, materials.map((material) => albedos(evaluator, material, VIEW_ANGLES)), VIEW_ANGLES);
    },
    what: () => "Share of the light that is reflected, over its angle,",
    told: ({ y }) => [0, 60, 80].map((angle) => `${short(y[VIEW_ANGLES.indexOf(angle)])} at ${angle}°`).join(", "),
    drawn(width, series) {
        const height = heightOf(width);
        const shares = ticks(Math.max(1, ...series.flatMap(({ y }) => Array.from(y))));
        const x = {
            low: 0, high: 90, ticks: [0, 15, 30, 45, 60, 75, 90].map((at) => ({ at, text: `${at}°` })),
            label: "light, from the normal",
        };
        const y = {
            low: 0, high: shares[shares.length - 1], ticks: shares.map((at) => ({ at, text: short(at) })),
            label: "share reflected",
        };
        const { px, py, inside, parts } = axes(width, height, x, y);
        inside.append(
            rule(0, py(1), width, py(1), { stroke: "var(--quiet)" }),
            ...series.map((one) => curve(Array.from(one.y, (share, i) => [px(one.x[i]), py(share)]), one)),
        );
        return { height, parts };
    },
});
