// What the readers of files share.

/**
 * A file as a material of the page.
 * @typedef {object} Parsed
 * @property {any} shader description of the shader; its textures lie in `texels`, `bytes` long from `offset`
 * @property {string} text GLSL
 * @property {ArrayBuffer} texels
 * @property {number} nbytes what the representation costs in memory
 * @property {boolean} isotropic
 * @property {string} kind class of the reflectance in Python
 * @property {string} [note]
 * @property {Uint8Array} [mask] bits of the measured nodes, the first in the lowest bit of a byte
 * @property {number[]} [mask_shape] nodes over theta_h, theta_d, phi_d
 *
 * Shaders of tables without their texels, see `library` of Python.
 * @typedef {{shader: any, text: string}} Template
 * @typedef {Template & {nodes: number[][], offset: number, margin: number}} Resampled
 * @typedef {{merl: Template, table: Resampled}} Library
 */

/** @param {Uint8Array} bytes */
export function textOf(bytes) {
    return new TextDecoder().decode(bytes);
}

/**
 * The name of a file without its folder and its extension.
 * @param {string} name
 */
export function stem(name) {
    return name.replace(/^.*[\\/]/, "").replace(/(.)\.[^.]*$/, "$1");
}

/**
 * The bytes of base64 text.
 * @param {string} text
 */
export function bytesOf(text) {
    return Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
}

/**
 * What gzip packed. Throws an Error when that is more than `most` bytes.
 * @param {Uint8Array<ArrayBuffer>} bytes
 * @param {number} most
 */
export async function unzipped(bytes, most) {
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")).getReader();
    const parts = [];
    let size = 0;
    for (let next = await reader.read(); !next.done; next = await reader.read()) {
        size += next.value.length;
        if (size > most) throw new Error("it unpacks to more than it may");
        parts.push(next.value);
    }
    return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/**
 * A material of one of the library's shaders.
 * @param {Template} template
 * @param {string} name
 * @param {string} source where it comes from
 * @param {Float32Array<ArrayBuffer>} texels RGBA of every node
 */
export function filled({ shader, text }, name, source, texels) {
    return { shader: { ...shader, name: stem(name), source }, text, texels: texels.buffer, isotropic: true };
}

/**
 * @param {ArrayLike<number>} numbers
 * @param {number} start
 * @param {number} end
 */
export function isFiniteList(numbers, start = 0, end = numbers.length) {
    for (let i = start; i < end; i++) if (!Number.isFinite(numbers[i])) return false;
    return true;
}
