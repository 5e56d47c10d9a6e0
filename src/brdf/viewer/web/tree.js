// A tree of boxes over a mesh's faces, as shadow.mesh.glsl walks it.

const BINS = 12;
const LEAF = 4;

/**
 * Two texels a node, depth first: (least corner, first face of a leaf, or -1 within the tree) and (greatest corner,
 * number of faces of a leaf, or the node to go on with where the box is missed); `order`: the faces as leaves count them.
 * @param {Float32Array} corners nine numbers a face
 * @returns {{order: Uint32Array, nodes: Float32Array}}
 */
export function treeOf(corners) {
    const count = corners.length / 9;
    const boxes = new Float32Array(count * 6);
    for (let f = 0; f < count; f++) {
        for (let k = 0; k < 3; k++) {
            const [a, b, c] = [corners[9 * f + k], corners[9 * f + 3 + k], corners[9 * f + 6 + k]];
            boxes[6 * f + k] = Math.min(a, b, c);
            boxes[6 * f + 3 + k] = Math.max(a, b, c);
        }
    }
    const order = Uint32Array.from({ length: count }, (_, i) => i);
    /** @type {number[]} */
    const nodes = [];
    const add = (/** @type {number} */ start, /** @type {number} */ stop) => {
        const node = nodes.length;
        const box = emptyBox();
        for (let i = start; i < stop; i++) enclose(box, boxes, 6 * order[i]);
        const leaf = stop - start <= LEAF;
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

function emptyBox() {
    return new Float32Array([Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity]);
}

/** @param {Float32Array} box @param {Float32Array} boxes @param {number} at where the other box stands in `boxes` */
function enclose(box, boxes, at) {
    for (let k = 0; k < 3; k++) {
        if (boxes[at + k] < box[k]) box[k] = boxes[at + k];
        if (boxes[at + 3 + k] > box[3 + k]) box[3 + k] = boxes[at + 3 + k];
    }
}

/** @param {Float32Array} box */
function area(box) {
    const [x, y, z] = [box[3] - box[0], box[4] - box[1], box[5] - box[2]];
    return x >= 0 ? x * y + y * z + z * x : 0;
}

/**
 * Parts order[start:stop] where rays cost least by the surface area heuristic [Wald2007], and says where that is.
 * @param {Float32Array} boxes
 * @param {Uint32Array} order
 * @param {number} start
 * @param {number} stop
 */
function parted(boxes, order, start, stop) {
    const middles = emptyBox();
    const middle = (/** @type {number} */ i, /** @type {number} */ k) => boxes[6 * i + k] + boxes[6 * i + 3 + k];
    for (let i = start; i < stop; i++) {
        for (let k = 0; k < 3; k++) {
            middles[k] = Math.min(middles[k], middle(order[i], k));
            middles[3 + k] = Math.max(middles[3 + k], middle(order[i], k));
        }
    }
    let best = { cost: Infinity, axis: -1, bin: 0 };
    const binOf = (/** @type {number} */ i, /** @type {number} */ k) =>
        Math.min(BINS - 1, Math.max(0, Math.floor(((middle(i, k) - middles[k]) / (middles[3 + k] - middles[k])) * BINS)));
    for (let axis = 0; axis < 3; axis++) {
        if (!(middles[3 + axis] > middles[axis])) continue;
        const counts = new Uint32Array(BINS);
        const bins = Array.from({ length: BINS }, emptyBox);
        for (let i = start; i < stop; i++) {
            const bin = binOf(order[i], axis);
            counts[bin]++;
            enclose(bins[bin], boxes, 6 * order[i]);
        }
        const costs = new Float64Array(BINS);
        for (const forward of [true, false]) {
            const box = emptyBox();
            let faces = 0;
            for (let step = 0; step < BINS - 1; step++) {
                const bin = forward ? step : BINS - 1 - step;
                enclose(box, bins[bin], 0);
                faces += counts[bin];
                costs[forward ? bin : bin - 1] += faces ? faces * area(box) : Infinity;
            }
        }
        for (let bin = 0; bin < BINS - 1; bin++) {
            if (costs[bin] < best.cost) best = { cost: costs[bin], axis, bin };
        }
    }
    if (best.axis < 0) return (start + stop) >> 1;
    let left = start;
    for (let i = start; i < stop; i++) {
        if (binOf(order[i], best.axis) > best.bin) continue;
        [order[i], order[left]] = [order[left], order[i]];
        left++;
    }
    return left;
}
