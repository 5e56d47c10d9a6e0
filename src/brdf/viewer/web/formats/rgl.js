// RGL's goniometer measurements, resampled for the graphics card.

import { Adaptive } from "./adaptive.js";
import { filled } from "./bytes.js";
import { tensorsOf } from "./tensors.js";

/**
 * The measurement as the library's table. Throws an Error of one sentence for what is no whole file.
 * @param {ArrayBuffer} buffer
 * @param {string} name
 * @param {import("./bytes.js").Library} library
 * @returns {Promise<import("./bytes.js").Parsed>}
 */
export async function parseRgl(buffer, name, library) {
    const tensors = tensorsOf(buffer, name);
    let measured;
    try {
        measured = new Adaptive(tensors);
        if (!measured.isotropic) {
            throw new Error("it is anisotropic, which only Python bakes: brdf export FILE page.html");
        }
    } catch (error) {
        const why = error instanceof Error ? error.message : error;
        throw new Error(`${name} is not a measurement that a page can show: ${why}.`);
    }
    const source = `RGL file ${name}`;
    const made = filled(library.table, name, source, resampled(measured, library.table));
    const note = `Shown by a table of ${library.table.nodes.map((axis) => axis.length).join(" x ")} nodes.`;
    return { ...made, nbytes: measured.nbytes, kind: "Adaptive", note };
}

/**
 * ln(f + offset) at the nodes over theta_h, theta_d, phi_d, as RGBA; those below the horizon take the value above it.
 * @param {Adaptive} measured
 * @param {import("./bytes.js").Resampled} table
 */
function resampled(measured, { nodes: [thetaH, thetaD, phiD], offset, margin }) {
    const texels = new Float32Array(4 * thetaH.length * thetaD.length * phiD.length).fill(1);
    const f = new Float64Array(3);
    let end = 0;
    for (const zenith of thetaH) {
        const half = Math.min(zenith, Math.PI / 2 - 2 * margin);
        const [sh, ch] = [Math.sin(half), Math.cos(half)];
        for (const difference of thetaD) {
            for (const phi of phiD) {
                const theta = Math.min(difference, Math.atan2(ch, sh * Math.abs(Math.cos(phi))) - margin);
                const [sd, cd] = [Math.sin(theta), Math.cos(theta)];
                const [hx, hz] = [cd * sh, cd * ch];
                const across = sd * Math.cos(phi);
                const [dx, dy, dz] = [across * ch, sd * Math.sin(phi), -across * sh];
                measured.evaluate(hx + dx, dy, hz + dz, hx - dx, -dy, hz - dz, f);
                for (let c = 0; c < 3; c++) texels[end + c] = Math.log(Math.max(f[c], 0) + offset);
                end += 4;
            }
        }
    }
    return texels;
}
