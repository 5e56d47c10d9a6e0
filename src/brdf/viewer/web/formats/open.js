// Files dropped onto the page as materials, recognised by their content.

import { isMerl, parseMerl } from "./merl.js";
import { parseRgl } from "./rgl.js";
import { isSafetensors, parseSafetensors } from "./safetensors.js";
import { isTensorFile } from "./tensors.js";

/** Bytes of the largest file that is read. */
const MOST = 256 * 2 ** 20;

const HEAD = 16;

/**
 * The material in a file: MERL's `.binary`, RGL's `.bsdf`, or `.safetensors`. Nothing is read before its size is known
 * to be one that a page can hold. Throws an Error of one sentence.
 * @param {File} file
 * @param {import("./bytes.js").Library} library
 * @returns {Promise<import("./bytes.js").Parsed>}
 */
export async function materialOf(file, library) {
    const { name, size } = file;
    if (size < HEAD) throw new Error(`${name} has ${size} bytes, too few for any material.`);
    if (size > MOST) throw new Error(`${name} has ${size} bytes; a page reads files of ${MOST} at most.`);
    const head = new Uint8Array(await file.slice(0, HEAD).arrayBuffer());
    const parse = parserOf(head, name.toLowerCase());
    if (!parse) throw new Error(`${name} is no MERL .binary, no RGL .bsdf and no .safetensors; these are read.`);
    return parse(await file.arrayBuffer(), name, library);
}

/**
 * By content; what content does not tell, by the extension, so that its reader may say what is wrong.
 * @param {Uint8Array} head
 * @param {string} name
 */
function parserOf(head, name) {
    if (isTensorFile(head) || name.endsWith(".bsdf")) return parseRgl;
    if (isMerl(head) || name.endsWith(".binary")) return parseMerl;
    return isSafetensors(head) || name.endsWith(".safetensors") ? parseSafetensors : null;
}
