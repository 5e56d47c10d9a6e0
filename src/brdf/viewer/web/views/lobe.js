// The lobe for one light as a solid that can be turned: its radius in a direction is f.

import { element } from "../element.js";
import { decades, DEGREE, luminances, Pairs, short, spherical } from "./numbers.js";
import { legend, PAIR } from "./plot.js";
import { choices, chosen, lightAngle, logarithmic, namesOf } from "./view.js";

/** Nodes over the zenith on either side of the mirror direction, and over the azimuth on either side of it. */
const [RINGS, SPOKES] = [22, 36];
const NODE_ROWS = 2 * RINGS + 1, NODE_COLUMNS = 2 * SPOKES + 1;

const LOBE_DECADES = 4;

/** Degrees a pixel. */
const TURNED = 0.5;

/** @typedef {{name: string, values: Float64Array, largest: number}} Lobe */

class Solid {
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    constructor(container, context) {
        this.context = context;
        const first = { log: true, angle: 45, azimuth: -60, elevation: 25 };
        const choosing = chosen(context, "lobe", first, () => this.update());
        this.options = choosing.options;
        this.refresh = choices(container, [lightAngle(choosing), logarithmic(choosing)]);
        this.canvas = element("canvas", { role: "img", tabindex: 0 });
        this.legend = legend();
        container.append(this.canvas, this.legend.element);
        /** @type {Lobe[]} */
        this.lobes = [];
        /** @type {number[][]} the directions of the nodes */
        this.directions = [];
        this.listen();
        this.observer = new ResizeObserver(() => this.draw());
        this.observer.observe(this.canvas);
    }

    /** Luminance of f [1/sr] in `directions`, a row for each zenith angle. */
    data() {
        return this.lobes.map((lobe) => ({ ...lobe, directions: this.directions }));
    }

    listen() {
        const { canvas, options } = this;
        const turn = (/** @type {number} */ across, /** @type {number} */ down) => {
            options.azimuth -= across;
            options.elevation = Math.min(90, Math.max(-5, options.elevation + down));
            this.draw();
        };
        let [x, y] = [0, 0];  // where the hand was: not every browser says how far a finger moved
        canvas.addEventListener("pointerdown", (event) => {
            canvas.setPointerCapture(event.pointerId);
            [x, y] = [event.clientX, event.clientY];
        });
        canvas.addEventListener("pointermove", (event) => {
            if (!(event.buttons & 1)) return;
            turn((event.clientX - x) * TURNED, (event.clientY - y) * TURNED);
            [x, y] = [event.clientX, event.clientY];
        });
        canvas.addEventListener("keydown", (event) => {
            const step = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5] }[event.key];
            if (!step) return;
            event.preventDefault();
            event.stopPropagation();
            turn(step[0], step[1]);
        });
    }

    update() {
        const { evaluator } = this.context;
        const materials = this.context.materials();
        const names = namesOf(materials);
        this.directions = nodeDirections(this.options.angle);
        const wi = spherical(this.options.angle * DEGREE, Math.PI);
        this.lobes = materials.map((material, m) => {
            const pairs = new Pairs(this.directions.length);
            for (const wo of this.directions) pairs.add(wi, wo);
            const values = luminances(pairs.values(evaluator, material));
            return { name: names[m], values, largest: values.reduce((most, value) => Math.max(most, value), 0) };
        });
        const what = this.lobes.map(({ name, largest }) => `${name}: luminance of f up to ${short(largest)} 1/sr`);
        const kind = this.options.log ? `logarithmic, over ${LOBE_DECADES} powers of ten` : "linear";
        const whose = `Lobe as a solid, light at ${this.options.angle}°, ${kind}.`;
        this.canvas.setAttribute("aria-label", `${whose} ${what.join("; ")}. Arrow keys turn it.`);
        this.refresh();
        this.legend.show(names.map((name, m) => ({ name, colour: PAIR[m].colour, dash: "" })));
        this.draw();
    }

    /** From f [1/sr] to a share of the radius. @returns {(f: number) => number} */
    get radius() {
        if (!this.options.log) {
            const largest = Math.max(1e-9, ...this.lobes.map((lobe) => lobe.largest));
            return (f) => f / largest;
        }
        const { low, high } = decades(this.lobes.map((lobe) => lobe.values), LOBE_DECADES);
        return (f) => (f > 0 ? Math.max(0, (Math.log10(f) - low) / (high - low)) : 0);
    }

    draw() {
        const { canvas, directions } = this;
        const width = canvas.clientWidth;
        if (!width || !directions.length) return;
        const height = Math.round(Math.min(0.72 * width, 320));
        const ratio = Math.min(window.devicePixelRatio || 1, 2);
        const size = { width: Math.round(width * ratio), height: Math.round(height * ratio) };
        if (canvas.width !== size.width || canvas.height !== size.height) {
            Object.assign(canvas, size);
            canvas.style.height = `${height}px`;
        }
        const ink = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
        ink.setTransform(ratio, 0, 0, ratio, 0, 0);
        ink.clearRect(0, 0, width, height);
        const camera = this.camera(width, height);
        const style = getComputedStyle(canvas);
        const named = (/** @type {string} */ name) => style.getPropertyValue(name).trim();
        this.ground(ink, camera, named);
        const colours = PAIR.map(({ colour }) => hexChannels(named(colour.slice(4, -1))));
        const { radius } = this;
        const facets = this.lobes.flatMap(({ values }, m) => {
            const points = directions.map((w, i) => camera.see(w.map((part) => part * radius(values[i]))));
            return this.facets(points, colours[m], m ? 0.55 : 1);
        });
        facets.sort((a, b) => a.depth - b.depth);
        for (const { corners, fill } of facets) {
            ink.fillStyle = ink.strokeStyle = fill;
            ink.beginPath();
            for (const [x, y] of corners) ink.lineTo(x, y);
            ink.closePath();
            ink.fill();
            ink.lineWidth = 0.5;
            ink.stroke();
        }
    }

    /**
     * Where points are seen, in pixels: x and y of the picture, and towards the eye.
     * @param {number} width
     * @param {number} height
     */
    camera(width, height) {
        const [sa, ca] = [Math.sin(this.options.azimuth * DEGREE), Math.cos(this.options.azimuth * DEGREE)];
        const [se, ce] = [Math.sin(this.options.elevation * DEGREE), Math.cos(this.options.elevation * DEGREE)];
        const [above, below] = [Math.max(1.2 * ce, Math.abs(se)) + 0.08, Math.abs(se) + 0.05];
        const scale = Math.min(width / 2.3, height / (above + below));
        const middle = (height * above) / (above + below);
        const see = (/** @type {number[]} */ [x, y, z]) => {
            const [across, toward] = [-sa * x + ca * y, ca * x + sa * y];
            const [up, near] = [z * ce - toward * se, toward * ce + z * se];
            return [width / 2 + scale * across, middle - scale * up, scale * near];
        };
        return { see };
    }

    /**
     * The surface, its normal, and where the light comes from.
     * @param {CanvasRenderingContext2D} ink
     * @param {{see: (point: number[]) => number[]}} camera
     * @param {(name: string) => string} named
     */
    ground(ink, { see }, named) {
        const line = (/** @type {number[][]} */ points, /** @type {string} */ colour, /** @type {number} */ thick) => {
            ink.strokeStyle = colour;
            ink.lineWidth = thick;
            ink.beginPath();
            for (const point of points) ink.lineTo(...(/** @type {[number, number]} */ (see(point).slice(0, 2))));
            ink.stroke();
        };
        const rim = Array.from({ length: 97 }, (_, i) => spherical(Math.PI / 2, (i * Math.PI) / 48));
        line(rim, named("--line"), 1);
        for (const [x, y] of [[1, 0], [0, 1]]) line([[-x, -y, 0], [x, y, 0]], named("--line"), 1);
        line([[0, 0, 0], [0, 0, 1]], named("--line"), 1);
        const wi = spherical(this.options.angle * DEGREE, Math.PI);
        line([[0, 0, 0], wi.map((part) => 1.1 * part)], named("--text"), 1.5);
        const [x, y] = see(wi.map((part) => 1.16 * part));
        ink.fillStyle = named("--quiet");
        ink.font = `11px ${getComputedStyle(this.canvas).fontFamily}`;
        ink.textAlign = "center";
        ink.fillText(`light, ${this.options.angle}°`, x, y);
    }

    /**
     * The solid's facets, shaded as by a lamp beside the eye.
     * @param {number[][]} points as they are seen
     * @param {number[]} colour
     * @param {number} opacity
     */
    facets(points, colour, opacity) {
        const found = [];
        for (let row = 0; row < NODE_ROWS - 1; row++) {
            for (let column = 0; column < NODE_COLUMNS - 1; column++) {
                const first = row * NODE_COLUMNS + column;
                const corners = [first, first + 1, first + NODE_COLUMNS + 1, first + NODE_COLUMNS].map((n) => points[n]);
                const [a, b, c, d] = corners;
                const [p, q] = [c.map((x, i) => x - a[i]), d.map((x, i) => x - b[i])];
                const normal = [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];
                const length = Math.hypot(...normal);
                if (!(length > 0)) continue;
                const facing = Math.abs(0.3 * normal[0] - 0.4 * normal[1] + 0.85 * normal[2]) / length;
                const shaded = colour.map((part) => Math.round(part * (0.4 + 0.6 * facing)));
                const depth = a[2] + b[2] + c[2] + d[2];
                found.push({ corners, depth, fill: `rgb(${shaded.join(" ")} / ${opacity})` });
            }
        }
        return found;
    }

    destroy() {
        this.observer.disconnect();
    }
}

/**
 * Directions that crowd around the mirror direction of light at `angle` [degrees] from the left: distances from it grow
 * as a square.
 * @param {number} angle
 */
function nodeDirections(angle) {
    const found = [];
    for (let i = -RINGS; i <= RINGS; i++) {
        const t = i / RINGS;
        const theta = angle + t * Math.abs(t) * (t < 0 ? angle : 89.9 - angle);
        for (let k = -SPOKES; k <= SPOKES; k++) {
            const v = k / SPOKES;
            found.push(spherical(theta * DEGREE, v * Math.abs(v) * Math.PI));
        }
    }
    return found;
}

/**
 * The channels of a colour written as #rrggbb.
 * @param {string} hex
 */
function hexChannels(hex) {
    return [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) || 0);
}

export const lobe = {
    id: "lobe",
    title: "3-D lobe",
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    create: (container, context) => new Solid(container, context),
};
