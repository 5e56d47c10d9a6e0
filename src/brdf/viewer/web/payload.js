// What Python hands to the page: one container of a JSON description and the bytes that it refers to.

/**
 * @typedef {{offset: number, bytes: number}} Ref Bytes of the blob.
 * @typedef {Ref & {rows: number, columns: number, bits: number, order: number}} NumbersRef
 * @typedef {{vertex: string, fragment: string}} Stage
 * @typedef {{name: string, uniform: string, size: number, value: number | number[], low?: number | null,
 *     high?: number | null, unit?: string, doc?: string}} Parameter
 * @typedef {{uniform: string, target: string, size: number[], internal_format: string, format: string, type: string,
 *     offset: number, bytes: number}} TextureDescription
 * @typedef {{version: number, language: string, function: string, name: string, source: string, unit: string,
 *     varies: boolean, transmits: boolean, parameters: Parameter[], textures: TextureDescription[]}} Description
 * @typedef {{shader: Description, text: string, texels: Ref | null, nbytes: number, isotropic?: boolean,
 *     kind?: string, lobe?: {alpha: number, share: number}, mask?: Ref | null, mask_shape?: number[],
 *     note?: string}} MaterialEntry
 * @typedef {{name: string, kind: string, [field: string]: any}} MeshEntry
 * @typedef {{name: string, width: number, height: number, pixels: NumbersRef}} EnvironmentEntry
 * @typedef {{version: number, title: string, stages: {mesh: Stage, sphere: Stage, evaluate: Stage, depth: Stage,
 *     tone: string, material: string}, materials: MaterialEntry[], comparison?: any, meshes: MeshEntry[],
 *     environments: EnvironmentEntry[], library?: any, state?: any}} Contents
 * @typedef {Contents & {bytes: (ref: Ref) => Uint8Array<ArrayBuffer>,
 *     numbers: (ref: NumbersRef) => Uint32Array}} Payload `numbers` gives rows one after the other.
 */

export const VERSION = 1;

/**
 * The contents, whose `bytes(ref)` are views of the blob. Throws an Error of one sentence for what is no payload.
 * @param {ArrayBuffer | ArrayBufferView} given
 * @returns {Payload}
 */
export function decode(given) {
    const buffer = aligned(given);
    const length = buffer.byteLength < 4 ? Infinity : new DataView(buffer).getUint32(0, true);
    if (length > buffer.byteLength - 4) throw new Error("The page's data is cut short; make the page again.");
    const contents = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
    if (contents.version !== VERSION) {
        throw new Error(`The page's data has version ${contents.version}, not ${VERSION}; make the page again.`);
    }
    const start = 4 + Math.ceil(length / 4) * 4;
    const bytes = (/** @type {Ref} */ { offset, bytes: count }) => {
        if (!(offset >= 0 && count >= 0 && start + offset + count <= buffer.byteLength)) {
            throw new Error("The page's data is cut short; make the page again.");
        }
        return new Uint8Array(buffer, start + offset, count);
    };
    return { ...contents, bytes, numbers: (/** @type {NumbersRef} */ ref) => unfolded(bytes(ref), ref) };
}

/**
 * Whole numbers from what Blob.add_numbers writes: bytes of differences, `order` times over, the lowest bytes of all
 * rows first, column by column; 0, 1, 2, 3, … there stand for 0, -1, 1, -2, …
 * @param {Uint8Array} planes
 * @param {NumbersRef} ref
 */
function unfolded(planes, { rows, columns, bits, order }) {
    const count = rows * columns;
    if (planes.length !== (count * bits) / 8) throw new Error("The page's data is cut short; make the page again.");
    const found = new Uint32Array(count);
    const mask = bits === 32 ? 0xffffffff : (1 << bits) - 1;
    for (let column = 0; column < columns; column++) {
        const running = new Uint32Array(order);
        for (let row = 0; row < rows; row++) {
            let folded = 0;
            for (let plane = 0; plane < bits / 8; plane++) {
                folded |= planes[plane * count + column * rows + row] << (8 * plane);
            }
            let value = (folded >>> 1) ^ -(folded & 1);
            for (let k = 0; k < order; k++) value = running[k] += value;
            found[row * columns + column] = value & mask;
        }
    }
    return found;
}

/**
 * @param {ArrayBuffer | ArrayBufferView} given
 * @returns {ArrayBuffer} whose first byte is the first of what is given
 */
function aligned(given) {
    if (given instanceof ArrayBuffer) return given;
    const part = new Uint8Array(given.buffer, given.byteOffset, given.byteLength);
    return part.slice().buffer;
}
