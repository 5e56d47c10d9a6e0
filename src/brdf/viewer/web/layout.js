// Which pictures stand where: one, two over each other, or two beside each other, beside what panels cover.

import { framing, placed, slopesOf } from "./camera.js";

/**
 * @typedef {import("./camera.js").Rectangle} Rectangle
 * @typedef {"first" | "second" | "split" | "difference"} Shown
 * @typedef {{slots: number[], shown: Shown, place: Rectangle, free: Rectangle}} Pane `slots`: 0 for A, 1 for B; `place`
 *     in the page's pixels from the top left corner of the canvas, `free` within it
 */

/**
 * @param {string} compare of the state
 * @param {{width: number, height: number}} canvas
 * @param {Rectangle} free what of the canvas no panel covers
 * @returns {Pane[]}
 */
export function panes(compare, canvas, free) {
    const whole = { x: 0, y: 0, ...canvas };
    if (compare !== "side") {
        const slots = { first: [0], second: [1] }[compare] ?? [0, 1];
        const shown = compare === "second" ? "first" : compare;
        return [{ slots, shown: /** @type {Shown} */ (shown), place: whole, free }];
    }
    const left = Math.round(free.x + free.width / 2);
    const right = { ...whole, x: left, width: canvas.width - left };
    const half = { width: free.width / 2, y: free.y, height: free.height };
    return [
        { slots: [0], shown: "first", place: { ...whole, width: left }, free: { ...half, x: free.x } },
        { slots: [1], shown: "first", place: right, free: { ...half, x: 0 } },
    ];
}

/** Frames meshes; what was found for the same mesh and space is kept. */
export class Framer {
    constructor() {
        this.key = "";
        this.framed = { target: /** @type {import("./vector.js").Vector} */ ([0, 0, 0]), distance: 1 };
    }

    /**
     * The camera of a pane.
     * @param {import("./mesh.js").Mesh} mesh
     * @param {Pane} pane
     * @param {{theta: number, phi: number, zoom: number, pan: number[]}} view
     */
    camera(mesh, pane, view) {
        const slopes = slopesOf(pane.place, pane.free);
        const key = `${mesh.name} ${slopes.map((slope) => slope.toFixed(5))}`;
        if (key !== this.key) {
            this.key = key;
            this.framed = framing(mesh.points, slopes);
        }
        return placed(view, this.framed, pane.place, pane.free);
    }
}
