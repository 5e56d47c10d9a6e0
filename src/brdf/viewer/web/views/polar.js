// Lobes in the plane of incidence, as polar curves.

import { toggle } from "../controls.js";
import { decades, DEGREE, inPlane, luminances, short, superscript, ticks, ANGLES_SEEN } from "./numbers.js";
import { COLOURS, curve, DASHES, Figure, PAIR, rule, svg, text } from "./plot.js";
import { choices, namesOf, remembered } from "./view.js";

/** Degrees from the normal, of the light. */
const ANGLES = [0, 30, 60, 80];

/** The same where two materials share the figure. */
const COMPARED_ANGLES = [30, 70];

const DECADES = 5;

/** Room for the names of the angles around the half disc, and below it. */
const MARGIN = 30;

/** @typedef {{radius: (value: number) => number, rings: {at: number, text: string}[]}} Scale */

class Polar {
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    constructor(container, context) {
        this.context = context;
        this.options = remembered(context, "polar", { log: true });
        this.refresh = choices(container, [toggle({
            label: "Logarithmic", read: () => this.options.log,
            write: (value) => {
                this.options.log = value;
                this.update();
            },
        })]);
        /** @type {(import("./view.js").Series & {angle: number, y: Float64Array})[]} */
        this.series = [];
        this.figure = new Figure(container, (width) => this.drawn(width));
    }

    /** The curves: luminance of f [1/sr] over the viewer's angle [degrees], light from the left. */
    data() {
        return this.series;
    }

    update() {
        const materials = this.context.materials();
        const names = namesOf(materials);
        const several = materials.length > 1;
        this.series = materials.flatMap((material, m) => (several ? COMPARED_ANGLES : ANGLES).map((angle, a) => ({
            name: several ? names[m] : `${angle}°`,
            angle,
            ...(several ? PAIR[m] : { colour: COLOURS[a], dash: DASHES[a] }),
            x: ANGLES_SEEN,
            y: luminances(inPlane(this.context.evaluator, material, angle, ANGLES_SEEN)),
        })));
        const peaks = this.series.map(({ name, angle, y }) => {
            const top = y.reduce((best, value, i) => (value > y[best] ? i : best), 0);
            const whose = several ? `${name}, light` : "Light";
            return `${whose} at ${angle}°: largest ${short(y[top])} at ${Math.round(ANGLES_SEEN[top])}°`;
        });
        const what = `Lobes of ${names.join(" and ")} in the plane of incidence, luminance of f [1/sr].`;
        const legend = several ? this.series.filter((_, i) => i % COMPARED_ANGLES.length === 0) : this.series;
        this.refresh();
        this.figure.show(`${what} ${peaks.join("; ")}.`, legend);
    }

    /** @returns {Scale} */
    get scale() {
        const lists = this.series.map((series) => series.y);
        if (this.options.log) {
            const { low, high } = decades(lists, DECADES);
            const step = high - low > 4 ? 2 : 1;
            const powers = Array.from({ length: Math.floor((high - low) / step) }, (_, i) => low + step * (i + 1));
            const rings = powers.map((power) => ({ at: 10 ** power, text: `10${superscript(power)}` }));
            return { rings, radius: (value) => Math.max(0, (Math.log10(value) - low) / (high - low)) };
        }
        const largest = Math.max(1e-9, ...lists.map((list) => Math.max(...Array.from(list))));
        const rings = ticks(largest, 3).filter((at) => at > 0 && at <= largest).map((at) => ({ at, text: short(at) }));
        return { rings, radius: (value) => value / largest };
    }

    /** @param {number} width */
    drawn(width) {
        const radius = Math.min(width / 2 - MARGIN, 240);
        const [x, y] = [width / 2, radius + MARGIN - 6];
        const place = (/** @type {number} */ angle, /** @type {number} */ share) => [
            x + radius * share * Math.sin(angle * DEGREE), y - radius * share * Math.cos(angle * DEGREE),
        ];
        const { rings, radius: share } = this.scale;
        const arc = (/** @type {number} */ r) => svg("path", {
            d: `M${x - r} ${y}A${r} ${r} 0 0 1 ${x + r} ${y}`, fill: "none", stroke: "var(--grid)",
        });
        const spokes = [-90, -60, -30, 0, 30, 60, 90];
        const parts = [
            arc(radius), ...rings.map((ring) => arc(radius * share(ring.at))),
            ...spokes.map((angle) => rule(x, y, ...(/** @type {[number, number]} */ (place(angle, 1))))),
            ...spokes.map((angle) => {
                const [px, py] = place(angle, 1);
                const [dx, dy] = [16 * Math.sin(angle * DEGREE), 4 - 10 * Math.cos(angle * DEGREE)];
                return text(`${Math.abs(angle)}°`, px + dx, py + dy);
            }),
            ...rings.map((ring) => text(ring.text, x + radius * share(ring.at), y + 15)),
            ...this.series.map((series) => curve(
                Array.from(series.y, (value, i) => place(series.x[i], value > 0 ? share(value) : 0)), series,
            )),
            ...this.lights.map(({ angle, colour }) => {
                const [px, py] = place(-angle, 1);
                return svg("path", {
                    d: "M-5 -5H5L0 5Z", fill: colour, transform: `translate(${px} ${py}) rotate(${-angle})`,
                });
            }),
            text("f [1/sr]", x + radius, y + 30, "end"),
            text("▾ light", x - radius, y + 30, "start"),
        ];
        return { height: y + 38, parts };
    }

    /** Where the light comes from, in the curves' colours where it has one for itself. */
    get lights() {
        if (this.context.materials().length === 1) return this.series;
        return COMPARED_ANGLES.map((angle) => ({ angle, colour: "var(--text)" }));
    }

    destroy() {
        this.figure.destroy();
    }
}

export const view = {
    id: "polar",
    title: "Lobes",
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    create: (container, context) => new Polar(container, context),
};
