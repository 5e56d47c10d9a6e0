// A tree of boxes over a mesh's faces, as shadow.mesh.glsl walks it.

const SPLITS = 16;
const LEAF = 4;

/**
 * Two texels a node, depth first: (least corner, first face of a leaf, or -1 within the tree) and (greatest corner,
 * number of faces of a leaf, or the node to go on with where the box is missed); `order`: the faces as leaves count
 * them.
 * @param {Float32Array} corners nine numbers a face
 * @returns {{order: Uint32Array, nodes: Float32Array}}
 */
export function treeOf(corners) {
    const count = corners.length / 9;
    const boxes = new Float32Array(count * 6);
    for (let i = 0; i < boxes.length; i++) {
        const at = Math.floor(i / 6) * 9 + (i % 3);
        const [a, b, c] = [corners[at], corners[at + 3], corners[at + 6]];
        boxes[i] = i % 6 < 3 ? Math.min(a, b, c) : Math.max(a, b, c);
    }
    const order = Uint32Array.from({ length: count }, (_, i) => i);
    /** @type {number[]} */
    const nodes = [];
    const add = (/** @type {number} */ start, /** @type {number} */ stop) => {
        const node = nodes.length;
        const leaf = stop - start <= LEAF;
        const box = new Float32Array(EMPTY);
        for (let i = start; i < stop; i++) enclose(box, 0, boxes, 6 * order[i]);
        nodes.push(box[0], box[1], box[2], leaf ? start : -1, box[3], box[4], box[5], stop - start);
        if (leaf) return;
        const middle = parted(boxes, order, start, stop);
        add(start, middle);
        add(middle, stop);
        nodes[node + 7] = nodes.length / 8;
    };
    if (count) add(0, count);
    return { order, nodes: Float32Array.from(nodes) };
}

/** A box that holds nothing. */
const EMPTY = [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];

/**
 * Widens the box that stands at a place of a list by one of another list.
 * @param {Float32Array} list
 * @param {number} at
 * @param {Float32Array} others
 * @param {number} other
 */
function enclose(list, at, others, other) {
    for (let k = 0; k < 3; k++) {
        if (others[other + k] < list[at + k]) list[at + k] = others[other + k];
        if (others[other + 3 + k] > list[at + 3 + k]) list[at + 3 + k] = others[other + 3 + k];
    }
}

/** @param {Float32Array} box */
function area(box) {
    const [x, y, z] = [box[3] - box[0], box[4] - box[1], box[5] - box[2]];
    return x * y + y * z + z * x;
}

const middles = new Float32Array(6);
const bins = new Float32Array(6 * SPLITS);
const counts = new Uint32Array(SPLITS);
const costs = new Float64Array(SPLITS);

/**
 * Parts order[start:stop] along the longest side where rays cost least by the surface area heuristic [Wald2007], and
 * says where that is.
 * @param {Float32Array} boxes
 * @param {Uint32Array} order
 * @param {number} start
 * @param {number} stop
 */
function parted(boxes, order, start, stop) {
    middles.set(EMPTY);
    for (let i = start; i < stop; i++) {
        for (let k = 0, at = 6 * order[i]; k < 3; k++, at++) {
            const middle = boxes[at] + boxes[at + 3];
            if (middle < middles[k]) middles[k] = middle;
            if (middle > middles[3 + k]) middles[3 + k] = middle;
        }
    }
    let axis = 0;
    const extent = (/** @type {number} */ k) => middles[3 + k] - middles[k];
    for (let k = 1; k < 3; k++) if (extent(k) > extent(axis)) axis = k;
    if (!(extent(axis) > 0)) return (start + stop) >> 1;
    const [low, scale] = [middles[axis], SPLITS / extent(axis)];
    const binOf = (/** @type {number} */ face) => {
        const middle = boxes[6 * face + axis] + boxes[6 * face + 3 + axis];
        return Math.min(SPLITS - 1, Math.max(0, Math.floor((middle - low) * scale)));
    };
    counts.fill(0);
    costs.fill(0);
    for (let bin = 0; bin < SPLITS; bin++) bins.set(EMPTY, 6 * bin);
    for (let i = start; i < stop; i++) {
        const bin = binOf(order[i]);
        counts[bin]++;
        enclose(bins, 6 * bin, boxes, 6 * order[i]);
    }
    for (const forward of [true, false]) {
        const box = new Float32Array(EMPTY);
        for (let step = 0, faces = 0; step < SPLITS - 1; step++) {
            const bin = forward ? step : SPLITS - 1 - step;
            enclose(box, 0, bins, 6 * bin);
            faces += counts[bin];
            costs[forward ? bin : bin - 1] += faces ? faces * area(box) : Infinity;
        }
    }
    let best = 0;
    for (let bin = 1; bin < SPLITS - 1; bin++) if (costs[bin] < costs[best]) best = bin;
    let left = start;
    for (let i = start; i < stop; i++) {
        const face = order[i];
        if (binOf(face) > best) continue;
        order[i] = order[left];
        order[left++] = face;
    }
    return left > start && left < stop ? left : (start + stop) >> 1;
}
