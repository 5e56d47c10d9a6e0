// RGL's tensor files: named arrays (see brdf.io.rgl).

import { textOf } from "./bytes.js";

const SIGNATURE = "tensor_file\0";
const MOST_FIELDS = 64;
const MOST_AXES = 8;

/** By the type's code in the file, which starts at 1: its name, its bytes, and what reads it. */
const TYPES = /** @type {const} */ ([
    ["uint8", 1, Uint8Array], ["int8", 1, Int8Array], ["uint16", 2, Uint16Array], ["int16", 2, Int16Array],
    ["uint32", 4, Uint32Array], ["int32", 4, Int32Array], ["uint64", 8, BigUint64Array], ["int64", 8, BigInt64Array],
    ["float16", 2, Uint16Array], ["float32", 4, Float32Array], ["float64", 8, Float64Array],
]);

/** @typedef {{type: string, shape: number[], numbers: any}} Tensor */

/** @param {Uint8Array} head */
export function recognises(head) {
    return textOf(head.subarray(0, SIGNATURE.length)) === SIGNATURE;
}

/**
 * Every field by name; sizes are checked against the file before memory is taken.
 * @param {ArrayBuffer} buffer
 * @param {string} name
 */
export function tensorsOf(buffer, name) {
    const size = buffer.byteLength;
    const view = new DataView(buffer);
    let place = 0;
    const next = (/** @type {number} */ bytes) => {
        place += bytes;
        if (place > size) throw new Error(`${name}: its table of contents ends at byte ${size}; fetch it again.`);
        return place - bytes;
    };
    const whole = () => Number(view.getBigUint64(next(8), true));
    const start = next(SIGNATURE.length + 2);
    if (!recognises(new Uint8Array(buffer, start)) || view.getUint16(start + SIGNATURE.length, true) !== 1) {
        throw new Error(`${name} is not a tensor file of version 1.0.`);
    }
    const count = view.getUint32(next(4), true);
    if (count > MOST_FIELDS) throw new Error(`${name} claims ${count} fields; at most ${MOST_FIELDS} are read.`);
    const entries = [];
    for (let i = 0; i < count; i++) {
        const length = view.getUint16(next(2), true);
        const field = textOf(new Uint8Array(buffer, next(length), length));
        const axes = view.getUint16(next(2), true);
        const code = view.getUint8(next(1));
        if (!TYPES[code - 1]) throw new Error(`${name}: its field '${field}' is of the unknown type ${code}.`);
        if (axes > MOST_AXES) {
            throw new Error(`${name}: its field '${field}' claims ${axes} axes; at most ${MOST_AXES} are read.`);
        }
        const offset = whole();
        entries.push({ field, code, offset, shape: Array.from({ length: axes }, whole) });
    }
    /** @type {Map<string, Tensor>} */
    const tensors = new Map();
    for (const { field, code, offset, shape } of entries) {
        const [type, width, Numbers] = TYPES[code - 1];
        const bytes = shape.reduce((product, n) => product * n, width);
        if (!(offset >= place && offset + bytes <= size)) {
            const claim = `bytes ${offset} to ${offset + bytes} of a file of ${size}`;
            throw new Error(`${name}: its field '${field}' claims ${claim}; fetch it again.`);
        }
        tensors.set(field, { type, shape, numbers: new Numbers(buffer.slice(offset, offset + bytes)) });
    }
    return tensors;
}
