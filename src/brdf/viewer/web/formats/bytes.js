/** What the readers of files share. */

/** The parts of a material, as a page draws it.
 * @typedef {object} Parsed
 * @property {any} shader description of the shader; its textures lie in `texels` at `offset`, `bytes` long
 * @property {string} text GLSL
 * @property {ArrayBuffer} texels
 * @property {number} nbytes what the representation costs in memory
 * @property {boolean} isotropic
 * @property {string} kind class of the reflectance in Python
 * @property {Uint8Array} [mask] bits of the measured nodes, the first in the highest bit of a byte
 * @property {number[]} [mask_shape] nodes over theta_h, theta_d, phi_d
 */

/** @typedef {Record<string, {shader: any, text: string, nodes?: number[][], offset?: number}>} Library */

/** @type {(bytes: Uint8Array) => string} */
export const textOf = (bytes) => new TextDecoder().decode(bytes);

/** The name a file has without its folder and its extension.
 * @type {(name: string) => string} */
export const stem = (name) => name.replace(/^.*[\\/]/, "").replace(/\.[^.]*$/, "");

/** The bytes of base64 text. @type {(text: string) => Uint8Array} */
export const bytesOf = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

/** What gzip packed, of which no more than `most` bytes are taken. @type {(bytes: Uint8Array, most: number) => Promise<Uint8Array>} */
export const unzipped = async (bytes, most) => {
    const reader = new Blob([/** @type {any} */ (bytes)]).stream().pipeThrough(new DecompressionStream("gzip")).getReader();
    const parts = [];
    let size = 0;
    for (let next = await reader.read(); !next.done; next = await reader.read()) {
        size += next.value.length;
        if (size > most) throw new Error("it unpacks to more than it may");
        parts.push(next.value);
    }
    const all = new Uint8Array(size);
    let end = 0;
    for (const part of parts) all.set(part, (end += part.length) - part.length);
    return all;
};
