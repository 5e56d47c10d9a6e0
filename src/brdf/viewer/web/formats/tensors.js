// RGL's tensor files: named arrays (see brdf.io.rgl).

import { textOf } from "./bytes.js";

const SIGNATURE = "tensor_file\0";
const MOST_FIELDS = 64;
const MOST_AXES = 8;

/** What reads each type, by its code in the file, which starts at 1; half precision is kept as its bits. */
const TYPES = [
    Uint8Array, Int8Array, Uint16Array, Int16Array, Uint32Array, Int32Array, BigUint64Array, BigInt64Array, Uint16Array,
    Float32Array, Float64Array,
];

/** @typedef {{shape: number[], numbers: any}} Tensor */

/** @param {Uint8Array} head */
export function isTensorFile(head) {
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
    if (!isTensorFile(new Uint8Array(buffer, start)) || view.getUint16(start + SIGNATURE.length, true) !== 1) {
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
        const Numbers = TYPES[code - 1];
        const bytes = shape.reduce((product, n) => product * n, Numbers.BYTES_PER_ELEMENT);
        if (!(offset >= place && offset + bytes <= size)) {
            const claim = `bytes ${offset} to ${offset + bytes} of a file of ${size}`;
            throw new Error(`${name}: its field '${field}' claims ${claim}; fetch it again.`);
        }
        tensors.set(field, { shape, numbers: new Numbers(buffer.slice(offset, offset + bytes)) });
    }
    return tensors;
}
