// MERL's measured tables (see brdf.io.merl and brdf.representations.tables.merl).

import { filled } from "./bytes.js";

const [ROWS, COLUMNS, TURN] = [90, 90, 180];
const BINS = ROWS * COLUMNS * TURN;
const HEADER = 12;
const SIZE = HEADER + 3 * 8 * BINS;

/** Stored value to f [1/sr] for red, green, blue. */
const FACTORS = [1.0, 1.15, 1.66].map((factor) => factor / 1500);

/** Nodes over phi_d: a copy of the first slice closes the circle. */
const NODES = TURN + 1;

/** @param {Uint8Array} head */
export function isMerl(head) {
    return String(dimensions(head)) === String([ROWS, COLUMNS, TURN]);
}

/** @param {Uint8Array} head */
function dimensions(head) {
    const view = new DataView(head.buffer, head.byteOffset);
    return [0, 4, 8].map((place) => view.getInt32(place, true));
}

/**
 * The bins as texels of the library's table. Throws an Error of one sentence for what is no whole file.
 * @param {ArrayBuffer} buffer
 * @param {string} name
 * @param {import("./bytes.js").Library} library
 * @returns {Promise<import("./bytes.js").Parsed>}
 */
export async function parseMerl(buffer, name, library) {
    const size = buffer.byteLength;
    if (size < HEADER) throw new Error(`${name} has ${size} bytes, too few for a MERL header (${HEADER}).`);
    if (!isMerl(new Uint8Array(buffer, 0, HEADER))) {
        const given = dimensions(new Uint8Array(buffer, 0, HEADER)).join(" x ");
        throw new Error(`${name}: its MERL header says ${given} bins; only ${ROWS} x ${COLUMNS} x ${TURN} is read.`);
    }
    if (size !== SIZE) {
        const fault = size < SIZE ? "it is truncated" : "something is appended";
        throw new Error(`${name}: expected ${SIZE} bytes, found ${size}: ${fault}; fetch it again.`);
    }
    const texels = new Float32Array(4 * ROWS * COLUMNS * NODES).fill(1);
    const holes = new Uint8Array(ROWS * COLUMNS * NODES);
    FACTORS.forEach((factor, channel) => {
        const start = HEADER + channel * 8 * BINS;
        const plane = new Float64Array(buffer.slice(start, start + 8 * BINS));  // aligned
        for (let bin = 0; bin < BINS; bin++) {
            const node = Math.floor(bin / TURN) * NODES + (bin % TURN);
            texels[4 * node + channel] = plane[bin] * factor;
            if (!Number.isFinite(texels[4 * node + channel])) {  // single precision, as it is kept
                const colour = ["red", "green", "blue"][channel];
                throw new Error(`${name}: its ${colour} plane holds NaN or infinity; fetch it again.`);
            }
            if (plane[bin] < 0) holes[node] = 1;
        }
    });
    if (!fill(texels, holes)) throw new Error(`${name} holds no measured bin; fetch it again.`);
    const measured = new Uint8Array(Math.ceil(holes.length / 8));
    holes.forEach((hole, node) => (measured[node >> 3] |= (1 - hole) << (node & 7)));
    return {
        ...filled(library.merl, name, `MERL file ${name}`, texels),
        nbytes: 12 * holes.length + measured.length,
        kind: "Table",
        mask: measured,
        mask_shape: [ROWS, COLUMNS, NODES],
    };
}

/**
 * Gives holes values that interpolation beside them can use: of the last measured bin of smaller theta_d, else the next
 * of larger theta_d, else of the nearest measured column; and closes the circle. False where nothing is measured.
 * @param {Float32Array} texels
 * @param {Uint8Array} holes
 */
function fill(texels, holes) {
    /** @type {(i: number, j: number, k: number) => number} */
    const at = (i, j, k) => (i * COLUMNS + j) * NODES + k;
    /** @type {(to: number, from: number) => void} */
    const copy = (to, from) => void texels.copyWithin(4 * to, 4 * from, 4 * from + 4);
    const full = [];
    for (let i = 0; i < ROWS; i++) {
        const known = [];
        for (let k = 0; k < TURN; k++) {
            let last = 0;
            while (last < COLUMNS && holes[at(i, last, k)]) last++;
            if (last === COLUMNS) continue;
            known.push(k);
            for (let j = 0; j < COLUMNS; j++) {
                if (holes[at(i, j, k)]) copy(at(i, j, k), at(i, last, k));
                else last = j;
            }
        }
        if (!known.length) continue;
        full.push(i);
        for (let k = 0; k < TURN; k++) {
            const apart = (/** @type {number} */ other) => Math.min(Math.abs(other - k), TURN - Math.abs(other - k));
            const from = nearest(known, apart);
            if (from !== k) for (let j = 0; j < COLUMNS; j++) copy(at(i, j, k), at(i, j, from));
        }
    }
    for (let i = 0; i < ROWS && full.length; i++) {
        const from = nearest(full, (other) => Math.abs(other - i));
        if (from !== i) texels.copyWithin(4 * at(i, 0, 0), 4 * at(from, 0, 0), 4 * at(from + 1, 0, 0));
        for (let j = 0; j < COLUMNS; j++) {
            copy(at(i, j, TURN), at(i, j, 0));
            holes[at(i, j, TURN)] = holes[at(i, j, 0)];
        }
    }
    return full.length > 0;
}

/**
 * @param {number[]} places
 * @param {(place: number) => number} distance
 */
function nearest(places, distance) {
    return places.reduce((best, place) => (distance(place) < distance(best) ? place : best));
}
