// f over the viewer's angle in the plane of incidence, for one light.

import { decades, inPlane, powers, SEEN, short, ticks } from "./numbers.js";
import { axes, curve, heightOf, rule, svg } from "./plot.js";
import { curvesOf, curveView, lightAngle, logarithmic } from "./view.js";

const DECADES = 6;

/**
 * The upright axis, and from f [1/sr] to where it lies on it.
 * @param {import("./view.js").Series[]} series
 * @param {boolean} log
 */
function scaled(series, log) {
    const lists = series.map(({ y }) => y);
    const label = "f [1/sr]";
    if (log) {
        const { low, high } = decades(lists, DECADES);
        const marks = powers(low, high).map(({ at, text }) => ({ at: Math.log10(at), text }));
        const of = (/** @type {number} */ f) => (f > 0 ? Math.max(Math.log10(f), low - 1) : NaN);
        return { axis: { low, high, label, ticks: marks }, of };
    }
    const list = ticks(Math.max(...lists.map((values) => Math.max(...values))));
    const marks = list.map((at) => ({ at, text: short(at) }));
    return { axis: { low: 0, high: list[list.length - 1], label, ticks: marks }, of: (/** @type {number} */ f) => f };
}

export const view = curveView({
    id: "slices",
    title: "Slices",
    options: { log: true, angle: 45 },
    controls: (chosen) => [lightAngle(chosen), logarithmic(chosen)],
    series({ evaluator }, materials, names, { angle }) {
        return curvesOf(names, materials.map((material) => inPlane(evaluator, material, angle, SEEN)), SEEN);
    },
    what: ({ angle }) => `f [1/sr] in the plane of incidence, light at ${angle}°,`,
    told: ({ y }) => `largest ${short(Math.max(...y))}, along the normal ${short(y[(y.length - 1) / 2])}`,
    drawn(width, series, { log, angle }) {
        const height = heightOf(width);
        const { axis, of } = scaled(series, log);
        const marks = [-90, -60, -30, 0, 30, 60, 90].map((at) => ({ at, text: `${Math.abs(at)}°` }));
        const x = { low: -90, high: 90, ticks: marks, label: "viewer, from the normal" };
        const { px, py, inside, parts } = axes(width, height, x, axis);
        inside.append(
            rule(px(angle), 0, px(angle), height, { stroke: "var(--quiet)", "stroke-dasharray": "1 3" }),
            svg("path", { d: "M-5 0H5L0 9Z", fill: "var(--text)", transform: `translate(${px(-angle)})` }),
            ...series.map((one) => curve(Array.from(one.y, (f, i) => [px(one.x[i]), py(of(f))]), one)),
        );
        return { height, parts };
    },
});
