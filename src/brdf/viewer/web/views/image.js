// The image slice: f over half and difference angle at one azimuth of the difference.

import { choice, toggle } from "../controls.js";
import { encode } from "../colour.js";
import { decades, DEGREE, fromHalf, luminances, Pairs, powers, short } from "./numbers.js";
import { axes, Figure, rule, svg, text } from "./plot.js";
import { choices, chosen, degrees, namesOf } from "./view.js";

/** Values along an axis, and pixels for each. */
const [CELLS, PIXELS] = [144, 3];

const IMAGE_DECADES = 4;

/** Share of the values that the scale holds: the few beside grazing incidence would take all of it. */
const HELD = 0.99;

/** Steps of the map cividis, even in lightness, the same to all colour vision. Reference: Nunez2018. */
const CIVIDIS = ["00224e", "1a386f", "434e6c", "61656f", "7d7c78", "9b9476", "bcae6c", "dfc95a", "fee838"].map((hex) =>
    [0, 2, 4].map((at) => parseInt(hex.slice(at, at + 2), 16)));

/** @typedef {{material: import("./view.js").Material, name: string, values: Float32Array, bright: Float64Array,
 *     above: Uint8Array, measured: Uint8Array}} Slice */

class ImageSlice {
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    constructor(container, context) {
        this.context = context;
        this.container = container;
        const first = { azimuth: 90, root: true, shown: "colour" };
        const choosing = chosen(context, "image", first, () => this.update());
        const { options, change } = choosing;
        this.options = options;
        this.refresh = choices(container, [
            choice({
                label: "Show", options: () => [["colour", "Colour"], ["luminance", "Luminance"]],
                read: () => options.shown, write: (shown) => change({ shown }),
            }),
            degrees(choosing, "azimuth", "Azimuth φd", "Azimuth of the light about the half vector", 180),
            toggle({ label: "√ θh", read: () => options.root, write: (root) => change({ root }) }),
        ]);
        /** @type {Slice[]} */
        this.slices = [];
        /** @type {Figure[]} */
        this.figures = [];
    }

    /** Rows over theta_d from 0 up, columns over theta_h: f [1/sr] as RGBA, whether directions are above the horizon,
     * whether the nearest node of a measured table was measured. */
    data() {
        return this.slices;
    }

    /** Half angle [rad] of a share of the axis, and back. @param {number} share */
    half(share) {
        return ((this.options.root ? share * share : share) * Math.PI) / 2;
    }

    update() {
        const materials = this.context.materials();
        const names = namesOf(materials);
        this.slices = materials.map((material, m) => ({ material, name: names[m], ...this.sliced(material) }));
        while (this.figures.length > materials.length) this.figures.pop()?.destroy();
        while (this.figures.length < materials.length) {
            const index = this.figures.length;
            this.figures.push(new Figure(this.container, (width) => this.drawn(this.slices[index], width)));
        }
        this.refresh();
        this.slices.forEach((slice, m) => this.figures[m].show(this.described(slice), []));
    }

    /** @param {import("./view.js").Material} material */
    sliced(material) {
        const pairs = new Pairs(CELLS * CELLS);
        const above = new Uint8Array(CELLS * CELLS);
        const measured = new Uint8Array(CELLS * CELLS);
        const phi = this.options.azimuth * DEGREE;
        const isMeasured = measuredNodes(material);
        for (let n = 0; n < CELLS * CELLS; n++) {
            const thetaH = this.half(((n % CELLS) + 0.5) / CELLS);
            const thetaD = ((Math.floor(n / CELLS) + 0.5) / CELLS) * 90 * DEGREE;
            const [wi, wo] = fromHalf(thetaH, thetaD, phi);
            pairs.add(wi, wo);
            above[n] = Number(wi[2] > 0 && wo[2] > 0);
            measured[n] = Number(isMeasured(thetaH, thetaD, phi));
        }
        const values = pairs.values(this.context.evaluator, material);
        return { values, bright: luminances(values), above, measured };
    }

    /** @param {Slice} slice */
    described({ name, values, bright, above, measured }) {
        const shown = Array.from(bright.filter((_, n) => above[n]));
        const largest = shown.reduce((most, value) => Math.max(most, value), 0);
        const holes = above.reduce((sum, one, n) => sum + (one && !measured[n] ? 1 : 0), 0);
        const missing = holes ? ` ${((100 * holes) / shown.length).toFixed(0)} % of it was not measured.` : "";
        const least = short(luminances(values.subarray(0, 4))[0]);
        const whose = `Slice of ${name} over half and difference angle at φd = ${this.options.azimuth}°`;
        return `${whose}: luminance of f up to ${short(largest)} 1/sr, ${least} where all directions meet.${missing}`;
    }

    /** Powers of ten that the luminances of all slices run between. */
    get range() {
        return decades(this.slices.map(({ bright, above }) => {
            const shown = bright.filter((_, n) => above[n]).sort();
            return shown.subarray(0, Math.ceil(HELD * shown.length));
        }), IMAGE_DECADES);
    }

    /**
     * @param {Slice} slice
     * @param {number} width
     */
    drawn(slice, width) {
        const size = Math.min(width, 360);
        const bright = this.options.shown === "luminance";
        const [low, high] = [0, 1];
        const { root } = this.options;
        const along = (root ? [0, 2, 10, 25, 50, 90] : [0, 30, 60, 90]).map((at) => {
            return { at: root ? Math.sqrt(at / 90) : at / 90, text: `${at}°` };
        });
        const x = { low, high, ticks: along, label: "half angle θh" };
        const up = [0, 30, 60, 90].map((at) => ({ at: at / 90, text: `${at}°` }));
        const title = this.slices.length > 1 ? 24 : 0;
        const framed = axes(size, Math.round(0.86 * size), x, { low, high, ticks: up, label: "difference angle θd" });
        const { left, inside } = framed;
        const [across, down] = [framed.right - left, framed.bottom - framed.top];
        inside.append(svg("image", {
            href: this.painted(slice), width: across, height: down, preserveAspectRatio: "none",
        }));
        const parts = [svg("g", { transform: `translate(0 ${title})` }, ...framed.parts)];
        if (title) parts.unshift(text(slice.name, left, 14, "start", { fill: "var(--text)", "font-size": 13 }));
        let height = title + Math.round(0.86 * size);
        if (slice.above.some((one, n) => one && !slice.measured[n])) {
            parts.push(...hatchKey(left, height + 4));
            height += 24;
        }
        if (bright) {
            parts.push(...this.bar(left, height + 8, across));
            height += 44;
        }
        return { height, parts };
    }

    /**
     * What the colours of luminance mean.
     * @param {number} x
     * @param {number} y
     * @param {number} width
     */
    bar(x, y, width) {
        const { low, high } = this.range;
        const step = width / 64;
        const cells = Array.from({ length: 64 }, (_, i) => svg("rect", {
            x: x + i * step, y, width: step + 0.5, height: 8, fill: `rgb(${cividis((i + 0.5) / 64)})`,
        }));
        const marks = powers(low, high).flatMap((power) => {
            const at = x + ((Math.log10(power.at) - low) / (high - low)) * width;
            const free = at < x + width - 64;  // beside the unit
            return [rule(at, y + 8, at, y + 12, { stroke: "var(--quiet)" }), text(free ? power.text : "", at, y + 24)];
        });
        return [...cells, ...marks, text("f [1/sr]", x + width, y + 24, "end")];
    }

    /**
     * The picture as a data address: hatched where nothing was measured, clear below the horizon.
     * @param {Slice} slice
     */
    painted({ values, bright, above, measured }) {
        const side = CELLS * PIXELS;
        const canvas = Object.assign(document.createElement("canvas"), { width: side, height: side });
        const ink = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
        const picture = ink.createImageData(side, side);
        const { low, high } = this.range;
        for (let row = 0; row < side; row++) {
            for (let column = 0; column < side; column++) {
                const n = (CELLS - 1 - Math.floor(row / PIXELS)) * CELLS + Math.floor(column / PIXELS);
                if (!above[n]) continue;
                const share = (Math.log10(bright[n]) - low) / (high - low);
                const colour = this.options.shown === "luminance" ? cividis(share)
                    : [0, 1, 2].map((c) => 255 * encode(Math.PI * values[4 * n + c]));
                const hatch = HATCH[Number((row + column) % 10 < 5)];
                picture.data.set(measured[n] ? [...colour, 255] : hatch, 4 * (row * side + column));
            }
        }
        ink.putImageData(picture, 0, 0);
        return canvas.toDataURL();
    }

    destroy() {
        for (const figure of this.figures) figure.destroy();
    }
}

/** Stripes over what was not measured. */
const HATCH = [[232, 232, 236, 255], [112, 112, 122, 255]];

/**
 * What the stripes mean.
 * @param {number} x
 * @param {number} y
 */
function hatchKey(x, y) {
    const [light, dark] = HATCH.map((colour) => `rgb(${colour.slice(0, 3)})`);
    const ground = svg("rect", { width: 24, height: 8, fill: light });
    const stripes = [-6, 0, 6, 12, 18].map((at) => rule(at, 8, at + 8, 0, { stroke: dark, "stroke-width": 2.5 }));
    const swatch = svg("svg", { x, y, width: 24, height: 8 }, ground, ...stripes);
    return [swatch, text("not measured", x + 32, y + 8, "start")];
}

/** @param {number} share of the map, clamped to [0, 1] */
function cividis(share) {
    const place = Math.min(Math.max(share || 0, 0), 1) * (CIVIDIS.length - 1);
    const i = Math.min(Math.floor(place), CIVIDIS.length - 2);
    return CIVIDIS[i].map((from, c) => Math.round(from + (place - i) * (CIVIDIS[i + 1][c] - from)));
}

/**
 * Whether the node nearest to half and difference angles [rad] was measured, of a table with MERL's nodes; else always.
 * @param {import("./view.js").Material} material
 * @returns {(thetaH: number, thetaD: number, phiD: number) => boolean}
 */
function measuredNodes({ source: { mask, mask_shape: shape } }) {
    const [rows, columns, turn] = shape ?? [];
    if (!mask || rows !== 90 || columns !== 90 || turn !== 181) return () => true;
    /** @type {(place: number, count: number) => number} */
    const nearest = (place, count) => Math.min(Math.round(place), count - 1);
    return (thetaH, thetaD, phiD) => {
        const i = nearest(90 * Math.sqrt((2 * thetaH) / Math.PI), rows);
        const n = (i * columns + nearest(thetaD / DEGREE, columns)) * turn + nearest(phiD / DEGREE, turn);
        return Boolean((mask[n >> 3] >> (n & 7)) & 1);
    };
}

export const image = {
    id: "image",
    title: "Image slice",
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    create: (container, context) => new ImageSlice(container, context),
};
