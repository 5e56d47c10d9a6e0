/** The package's own files: safetensors whose header carries a shader (see `brdf.shaders.embedded`). */

import { bytesOf, stem, textOf, unzipped } from "./bytes.js";

const LARGEST_HEADER = 100e6;  // the format's bound
const LARGEST_SHADER = 4e6;
const SCHEMA = 1;
const BYTES = { F64: 8, F32: 4, F16: 2, U64: 8, I64: 8, U32: 4, I32: 4, U16: 2, I16: 2, U8: 1, I8: 1, BOOL: 1 };
const CHANNELS = { RED: 1, RG: 2, RGBA: 4 };

/** @typedef {{dtype: string, shape: number[], bytes: Uint8Array}} Tensor */

/** @type {(buffer: ArrayBuffer, name: string, library: import("./bytes.js").Library) => Promise<import("./bytes.js").Parsed>} */
export const parse = async (buffer, name, library) => {
    const { metadata, tensors } = contents(buffer, name);
    let header;
    try {
        header = JSON.parse(metadata.brdf);
    } catch {
        throw new Error(`${name}: a safetensors file, but not one of brdf's (its header is missing).`);
    }
    if (header.schema > SCHEMA) throw new Error(`${name} was written by a newer brdf; make the page with that one.`);
    if (!header.shader) throw new Error(`${name} carries no shader: an earlier brdf wrote it, or it has no formula. ` +
        "Save it again, or bake it: brdf convert FILE new.safetensors --as slice-stack");
    try {
        const packed = bytesOf(header.shader);
        const { text, description, nbytes, isotropic } = JSON.parse(textOf(await unzipped(packed, LARGEST_SHADER)));
        const { textures, texels } = uploads(description.textures, tensors);
        const shader = { ...description, textures, name: description.name || stem(name) };
        return { shader, text: String(text), texels, nbytes, isotropic, kind: header.kind };
    } catch (error) {
        throw new Error(`${name}: its shader cannot be read (${error instanceof Error ? error.message : error}).`);
    }
};

/** Header and tensors; every size is checked against the file.
 * @type {(buffer: ArrayBuffer, name: string) => {metadata: Record<string, string>, tensors: Map<string, Tensor>}} */
const contents = (buffer, name) => {
    const size = buffer.byteLength;
    if (size < 8) throw new Error(`${name} has ${size} bytes, too few for a safetensors file (8).`);
    const length = Number(new DataView(buffer).getBigUint64(0, true));
    if (length > LARGEST_HEADER || length + 8 > size)
        throw new Error(`${name} claims a header of ${length} bytes in a file of ${size}; it is truncated, or not a safetensors file.`);
    let header;
    try {
        header = JSON.parse(textOf(new Uint8Array(buffer, 8, length)));
    } catch {
        throw new Error(`${name} is not a safetensors file: its header is not JSON.`);
    }
    const { __metadata__: metadata, ...entries } = header;
    const tensors = new Map();
    for (const [key, entry] of Object.entries(entries)) {
        const { dtype, shape, data_offsets: [start, end] = [0, -1] } = /** @type {any} */ (entry);
        const bytes = shape?.reduce?.((/** @type {number} */ product, /** @type {number} */ n) => product * n,
            BYTES[/** @type {keyof BYTES} */ (dtype)]);
        if (!(start >= 0 && end >= start && end - start === bytes && end <= size - 8 - length))
            throw new Error(`${name}: its tensor '${key}' claims bytes ${start} to ${end} of ${size - 8 - length}; fetch it again.`);
        tensors.set(key, { dtype, shape, bytes: new Uint8Array(buffer, 8 + length + start, end - start) });
    }
    return { metadata: metadata ?? {}, tensors };
};

/** The textures as they are uploaded, and their texels one after the other.
 * @type {(textures: any[], tensors: Map<string, Tensor>) => {textures: any[], texels: ArrayBuffer}} */
const uploads = (textures, tensors) => {
    const parts = textures.map((texture) => texelsOf(texture, tensors));
    const texels = new Uint8Array(parts.reduce((sum, part) => sum + padded(part.length), 0));
    let offset = 0;
    const placed = textures.map(({ stored, ...texture }, index) => {
        const bytes = parts[index].length;
        texels.set(parts[index], offset);
        offset += padded(bytes);
        return { ...texture, offset: offset - padded(bytes), bytes };
    });
    return { textures: placed, texels: texels.buffer };
};

/** @type {(bytes: number) => number} */
const padded = (bytes) => bytes + (-bytes & 3);

/** @type {(texture: any, tensors: Map<string, Tensor>) => Uint8Array} */
const texelsOf = ({ size, format, stored }, tensors) => {
    const tensor = tensors.get(stored.tensor);
    if (!tensor) throw new Error(`there is no tensor '${stored.tensor}'`);
    const pixels = size.reduce((/** @type {number} */ product, /** @type {number} */ n) => product * n, 1);
    const source = numbers(tensor), width = source.length / pixels;
    const given = stored.packing ? 1 : stored.channels, first = stored.first ?? 0;
    if (!(width % 1 === 0 && given >= 1 && first >= 0 && first + given <= width))
        throw new Error(`tensor '${stored.tensor}' does not fill ${size.join(" x ")} texels`);
    if (stored.packing === "words") return new Uint8Array(Uint32Array.from(source, (word) => word | (3 << 30)).buffer);
    if (stored.packing) return sharedExponents(source);
    const levels = stored.levels ? numbers(/** @type {Tensor} */ (tensors.get(stored.levels))) : null;
    const channels = CHANNELS[/** @type {keyof CHANNELS} */ (format)];
    const made = levels ? new Float32Array(pixels * channels) : empty(tensor.dtype, pixels * channels);
    if (channels > given) made.fill(levels ? 1 : one(tensor.dtype));
    for (let pixel = 0; pixel < pixels; pixel++)
        for (let c = 0; c < given; c++) {
            const number = source[pixel * width + first + c];
            made[pixel * channels + c] = levels ? levels[number * given + c] : number;
        }
    return new Uint8Array(made.buffer);
};

/** A tensor's numbers, half precision as its bits. @type {(tensor: Tensor) => ArrayLike<number> & Iterable<number>} */
const numbers = ({ dtype, bytes }) => {
    const copy = bytes.slice().buffer;  // aligned, as the file may not be
    switch (dtype) {
        case "F64": return new Float64Array(copy);
        case "F32": return new Float32Array(copy);
        case "F16": return new Uint16Array(copy);
        case "U32": return new Uint32Array(copy);
        case "U8": return new Uint8Array(copy);
        default: throw new Error(`numbers of type ${dtype} are no texels`);
    }
};

/** @type {(dtype: string, count: number) => Float32Array | Uint16Array | Uint8Array} */
const empty = (dtype, count) =>
    dtype === "F16" ? new Uint16Array(count) : dtype === "U8" ? new Uint8Array(count) : new Float32Array(count);

/** What stands for 1. @type {(dtype: string) => number} */
const one = (dtype) => (dtype === "F16" ? 0x3c00 : dtype === "U8" ? 255 : 1);

/** Words of 9 bits a channel and a common exponent, as RGBA32F. @type {(words: ArrayLike<number>) => Uint8Array} */
const sharedExponents = (words) => {
    const made = new Float32Array(4 * words.length).fill(1);
    for (let i = 0; i < words.length; i++)
        for (let c = 0; c < 3; c++)
            made[4 * i + c] = ((words[i] >>> (9 * c)) & 511) * 2 ** ((words[i] >>> 27) - 24);
    return new Uint8Array(made.buffer);
};
