// The package's own files: safetensors whose header carries a shader (see brdf.shaders.embedded).

import { bytesOf, stem, textOf, unzipped } from "./bytes.js";

/** The bound that the format sets. */
const LARGEST_HEADER = 100e6;

const LARGEST_SHADER = 4e6;

/** Schema of the headers that this reads. */
const SCHEMA = 1;

/** What reads the types that textures are made of; half precision is kept as its bits. */
const ARRAYS = { F64: Float64Array, F32: Float32Array, F16: Uint16Array, U32: Uint32Array, U8: Uint8Array };

/** What stands for 1 in a texture. */
const ONES = { F64: 1, F32: 1, F16: 0x3c00, U32: 1, U8: 255 };

/** @type {Record<string, number>} */
const CHANNELS_OF = { RED: 1, RG: 2, RGBA: 4 };

/** @typedef {{dtype: string, bytes: Uint8Array<ArrayBuffer>}} Tensor */

/** @param {Uint8Array} head */
export function isSafetensors(head) {
    return head[8] === 0x7b && new DataView(head.buffer, head.byteOffset).getUint32(4, true) === 0;
}

/**
 * Throws an Error of one sentence for what is no whole file, or carries no shader.
 * @param {ArrayBuffer} buffer
 * @param {string} name
 * @returns {Promise<import("./bytes.js").Parsed>}
 */
export async function parseSafetensors(buffer, name) {
    const { metadata, tensors } = opened(buffer, name);
    const header = objectOf(metadata?.brdf);
    if (!header) throw new Error(`${name} is a safetensors file, but not one of brdf's: its header is missing.`);
    if (header.schema > SCHEMA) throw new Error(`${name} was written by a newer brdf; make the page with that one.`);
    if (!header.shader) {
        throw new Error(
            `${name} carries no shader: an earlier brdf wrote it, or it has no formula. Save it again, or bake it: ` +
                "brdf convert FILE baked.safetensors --as slice-stack.",
        );
    }
    try {
        const packed = bytesOf(header.shader);
        const { text, description, nbytes, isotropic } = JSON.parse(textOf(await unzipped(packed, LARGEST_SHADER)));
        for (const part of ["textures", "parameters"]) {
            if (!Array.isArray(description?.[part])) throw new Error(`it has no list of ${part}`);
        }
        const { textures, texels } = uploads(description.textures, tensors);
        const shader = { ...description, textures, name: description.name || stem(name) };
        return { shader, text: String(text), texels, nbytes, isotropic, kind: header.kind };
    } catch (error) {
        const why = error instanceof Error ? error.message : error;
        throw new Error(`${name}: the shader in it cannot be read (${why}); save the file again.`);
    }
}

/**
 * Header and tensors; every size is checked against the file.
 * @param {ArrayBuffer} buffer
 * @param {string} name
 */
function opened(buffer, name) {
    const size = buffer.byteLength;
    if (size < 8) throw new Error(`${name} has ${size} bytes, too few for a safetensors file (8).`);
    const length = Number(new DataView(buffer).getBigUint64(0, true));
    if (length > Math.min(LARGEST_HEADER, size - 8)) {
        const wrong = "it is truncated, or no safetensors file";
        throw new Error(`${name} claims a header of ${length} bytes in a file of ${size}: ${wrong}.`);
    }
    const header = objectOf(textOf(new Uint8Array(buffer, 8, length)));
    if (!header) throw new Error(`${name} is not a safetensors file: its header is not JSON.`);
    const start = 8 + length;
    const { __metadata__: metadata, ...entries } = header;
    /** @type {Map<string, Tensor>} */
    const tensors = new Map();
    for (const [key, entry] of Object.entries(entries)) {
        const { dtype, data_offsets: place } = entry ?? {};
        const [from, to] = Array.isArray(place) ? place : [NaN, NaN];
        if (!(from >= 0 && to >= from && start + to <= size)) {
            const claim = `bytes ${from} to ${to} of ${size - start}`;
            throw new Error(`${name}: its tensor '${key}' claims ${claim}; fetch the file again.`);
        }
        tensors.set(key, { dtype, bytes: new Uint8Array(buffer, start + from, to - from) });
    }
    return { metadata, tensors };
}

/**
 * The object that a JSON text is, or null.
 * @param {string} text
 */
function objectOf(text) {
    try {
        const value = JSON.parse(text);
        return typeof value === "object" ? value : null;
    } catch {
        return null;
    }
}

/**
 * The textures as they are uploaded, and their texels one after the other.
 * @param {any[]} textures
 * @param {Map<string, Tensor>} tensors
 */
function uploads(textures, tensors) {
    const parts = textures.map((texture) => texelsOf(texture, tensors));
    const padded = (/** @type {Uint8Array} */ { length }) => length + (-length & 3);
    const texels = new Uint8Array(parts.reduce((sum, part) => sum + padded(part), 0));
    let end = 0;
    const placed = textures.map(({ stored: _, ...texture }, index) => {
        const offset = end;
        texels.set(parts[index], offset);
        end += padded(parts[index]);
        return { ...texture, offset, bytes: parts[index].length };
    });
    return { textures: placed, texels: texels.buffer };
}

/**
 * One texture's texels, from the tensor that `stored` names.
 * @param {{size: number[], format: string, stored: any}} texture
 * @param {Map<string, Tensor>} tensors
 */
function texelsOf({ size, format, stored }, tensors) {
    const { dtype, numbers } = numbersOf(tensors, stored.tensor);
    const { packing, first = 0, channels: given = 1 } = stored;
    const pixels = size.reduce((product, n) => product * n, 1);
    const width = numbers.length / pixels;
    if (!(Number.isInteger(width) && first >= 0 && given >= 1 && first + given <= width)) {
        throw new Error(`tensor '${stored.tensor}' does not fill ${size.join(" x ")} texels`);
    }
    if (packing === "words") return new Uint8Array(Uint32Array.from(numbers, (word) => word | (3 << 30)).buffer);
    if (packing) return new Uint8Array(sharedExponents(numbers).buffer);
    const levels = stored.levels ? numbersOf(tensors, stored.levels).numbers : null;
    const kept = dtype === "F64" || levels ? "F32" : dtype;
    const channels = CHANNELS_OF[format];
    const texels = new ARRAYS[kept](pixels * channels);
    if (channels > given) texels.fill(ONES[kept]);
    for (let pixel = 0; pixel < pixels; pixel++) {
        for (let c = 0; c < given; c++) {
            const number = numbers[pixel * width + first + c];
            texels[pixel * channels + c] = levels ? levels[number * given + c] : number;
        }
    }
    return new Uint8Array(texels.buffer);
}

/**
 * @param {Map<string, Tensor>} tensors
 * @param {string} name
 */
function numbersOf(tensors, name) {
    const tensor = tensors.get(name);
    if (!tensor || !(tensor.dtype in ARRAYS)) throw new Error(`there are no texels '${name}'`);
    const dtype = /** @type {keyof ARRAYS} */ (tensor.dtype);
    return { dtype, numbers: new ARRAYS[dtype](tensor.bytes.slice().buffer) };  // a copy, for files may not be aligned
}

/**
 * Words of 9 bits a channel and a common exponent as RGBA.
 * @param {ArrayLike<number>} words
 */
function sharedExponents(words) {
    const texels = new Float32Array(4 * words.length).fill(1);
    for (let i = 0; i < words.length; i++) {
        const scale = 2 ** ((words[i] >>> 27) - 24);
        for (let c = 0; c < 3; c++) texels[4 * i + c] = ((words[i] >>> (9 * c)) & 511) * scale;
    }
    return texels;
}
