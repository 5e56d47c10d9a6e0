// Meshes from the few bytes that the page carries: the texels that the stages read, and what frames them.

import { treeOf } from "./tree.js";

/**
 * @typedef {{name: string, exact: boolean, faces: number, hasUv: boolean, nudge: number, least: number[],
 *     greatest: number[], points: Float32Array, texels: Float32Array, nodes: Float32Array}} Mesh
 *     `exact`: the unit sphere in closed form; `points`: x, y, z of what must be seen.
 */

const LEVELS = 65535;

/**
 * @param {import("./payload.js").MeshEntry} entry
 * @param {import("./payload.js").Payload} payload
 * @returns {Mesh}
 */
export function decodedMesh(entry, payload) {
    if (entry.kind === "sphere") return sphere(entry.name);
    const positions = spread(payload.numbers(entry.positions), entry.least, entry.greatest);
    const folded = spread(payload.numbers(entry.normals), [-1, -1], [1, 1]);
    const uvs = entry.has_uv ? spread(payload.numbers(entry.uvs), entry.uv_least, entry.uv_greatest) : null;
    const corners = payload.numbers(entry.corners);
    const normals = octahedral(folded);
    const places = new Float32Array(corners.length * 3);
    corners.forEach((vertex, i) => places.set(positions.subarray(3 * vertex, 3 * vertex + 3), 3 * i));
    const { order, nodes } = treeOf(places);
    const texels = new Float32Array(corners.length * 8);
    for (let f = 0; f < order.length; f++) {
        for (let c = 0; c < 3; c++) {
            const vertex = corners[3 * order[f] + c];
            const at = 24 * f + 4 * c;
            texels.set(positions.subarray(3 * vertex, 3 * vertex + 3), at);
            texels.set(normals.subarray(3 * vertex, 3 * vertex + 3), at + 12);
            if (!uvs) continue;
            texels[at + 3] = uvs[2 * vertex];
            texels[at + 15] = uvs[2 * vertex + 1];
        }
    }
    return {
        name: entry.name, exact: false, faces: order.length, hasUv: entry.has_uv, nudge: entry.nudge,
        least: entry.least, greatest: entry.greatest, points: positions, texels, nodes,
    };
}

/** @param {string} name @returns {Mesh} */
function sphere(name) {
    const points = [];
    for (let theta = 0; theta <= 180; theta += 7.5) {
        for (let phi = 0; phi < 360; phi += 7.5) {
            const [t, p] = [(theta * Math.PI) / 180, (phi * Math.PI) / 180];
            points.push(Math.sin(t) * Math.sin(p), Math.cos(t), Math.sin(t) * Math.cos(p));
        }
    }
    const none = new Float32Array(0);
    return {
        name, exact: true, faces: 0, hasUv: true, nudge: 0, least: [-1, -1, -1], greatest: [1, 1, 1],
        points: Float32Array.from(points), texels: none, nodes: none,
    };
}

/**
 * Steps of columns as numbers between bounds.
 * @param {Uint32Array} steps
 * @param {number[]} least
 * @param {number[]} greatest
 */
function spread(steps, least, greatest) {
    const columns = least.length;
    return Float32Array.from(steps, (step, i) => {
        const k = i % columns;
        return least[k] + (step / LEVELS) * (greatest[k] - least[k]);
    });
}

/**
 * Unit vectors from places on the octahedron [Cigolle2014].
 * @param {Float32Array} folded
 */
function octahedral(folded) {
    const normals = new Float32Array((folded.length / 2) * 3);
    for (let i = 0; i < folded.length / 2; i++) {
        let [x, y] = [folded[2 * i], folded[2 * i + 1]];
        const z = 1 - Math.abs(x) - Math.abs(y);
        if (z < 0) {
            const [a, b] = [1 - Math.abs(y), 1 - Math.abs(x)];
            [x, y] = [x >= 0 ? a : -a, y >= 0 ? b : -b];
        }
        const length = Math.hypot(x, y, z);
        normals.set([x / length, y / length, z / length], 3 * i);
    }
    return normals;
}
