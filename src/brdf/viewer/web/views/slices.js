// f over the viewer's angle in the plane of incidence, for one light.

import { slider, toggle } from "../controls.js";
import { channelOf, decades, inPlane, luminances, short, superscript, ticks, ANGLES_SEEN } from "./numbers.js";
import { axes, CHANNELS, curve, Figure, PAIR, rule, svg } from "./plot.js";
import { choices, namesOf, remembered } from "./view.js";

const DECADES = 6;

class Slices {
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    constructor(container, context) {
        this.context = context;
        this.options = remembered(context, "slices", { log: true, angle: 45 });
        this.refresh = choices(container, [
            slider({
                label: "Light", doc: "Angle of the light from the normal", scale: { low: 0, high: 85, unit: "°" },
                read: () => this.options.angle,
                write: (value) => {
                    this.options.angle = Math.min(85, Math.max(0, Math.round(value)));
                    this.update();
                },
            }),
            toggle({
                label: "Logarithmic", read: () => this.options.log,
                write: (value) => {
                    this.options.log = value;
                    this.update();
                },
            }),
        ]);
        /** @type {import("./view.js").Series[]} */
        this.series = [];
        this.figure = new Figure(container, (width) => this.drawn(width));
    }

    /** The curves: f [1/sr] over the viewer's angle [degrees]; by channel, of two materials the luminance. */
    data() {
        return this.series;
    }

    update() {
        const { evaluator } = this.context;
        const materials = this.context.materials();
        const names = namesOf(materials);
        const values = materials.map((material) => inPlane(evaluator, material, this.options.angle, ANGLES_SEEN));
        this.series = materials.length > 1
            ? values.map((list, m) => ({ name: names[m], ...PAIR[m], x: ANGLES_SEEN, y: luminances(list) }))
            : CHANNELS.map((channel, c) => ({ ...channel, x: ANGLES_SEEN, y: channelOf(values[0], c) }));
        const what = this.series.map(({ name, y }) => {
            const [largest, middle] = [Math.max(...Array.from(y)), y[(y.length - 1) / 2]];
            return `${name}: largest ${short(largest)}, along the normal ${short(middle)}`;
        });
        this.refresh();
        const whose = `f [1/sr] of ${names.join(" and ")} in the plane of incidence, light at ${this.options.angle}°.`;
        this.figure.show(`${whose} ${what.join("; ")}.`, this.series);
    }

    get scale() {
        const lists = this.series.map((series) => series.y);
        if (this.options.log) {
            const { low, high } = decades(lists, DECADES);
            const powers = Array.from({ length: Math.floor(high) - low + 1 }, (_, i) => low + i);
            const marks = powers.map((at) => ({ at, text: `10${superscript(at)}` }));
            const of = (/** @type {number} */ f) => (f > 0 ? Math.max(Math.log10(f), low - 1) : NaN);
            return { low, high, ticks: marks, of };
        }
        const list = ticks(Math.max(0, ...lists.flatMap((values) => Array.from(values))));
        const marks = list.map((at) => ({ at, text: short(at) }));
        return { low: 0, high: list[list.length - 1], ticks: marks, of: (/** @type {number} */ f) => f };
    }

    /** @param {number} width */
    drawn(width) {
        const height = Math.round(Math.min(320, 0.62 * width + 40));
        const { of, ...y } = this.scale;
        const angles = [-90, -60, -30, 0, 30, 60, 90].map((at) => ({ at, text: `${Math.abs(at)}°` }));
        const x = { low: -90, high: 90, ticks: angles, label: "viewer, from the normal" };
        const { px, py, inside, parts, top, bottom } = axes(width, height, x, { ...y, label: "f [1/sr]" });
        const light = px(-this.options.angle), mirror = px(this.options.angle);
        inside.append(
            rule(mirror, 0, mirror, bottom - top, { stroke: "var(--quiet)", "stroke-dasharray": "1 3" }),
            svg("path", { d: "M-5 0H5L0 9Z", fill: "var(--text)", transform: `translate(${light} 0)` }),
            ...this.series.map(({ x: angle, y: list, ...style }) => {
                return curve(Array.from(list, (f, i) => [px(angle[i]), py(of(f))]), style);
            }),
        );
        return { height, parts };
    }

    destroy() {
        this.figure.destroy();
    }
}

export const view = {
    id: "slices",
    title: "Slices",
    /**
     * @param {HTMLElement} container
     * @param {import("./view.js").Context} context
     */
    create: (container, context) => new Slices(container, context),
};
