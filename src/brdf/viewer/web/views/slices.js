// f over the viewer's angle in the plane of incidence, for one light.

import { inPlane, SEEN, short } from "./numbers.js";
import { axes, curve, heightOf, rule, svg } from "./plot.js";
import { curvesOf, curveView, lightAngle, logarithmic, scaled } from "./view.js";

const SLICE_DECADES = 6;

export const slices = curveView({
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
        const { of, ...y } = scaled(series, log, SLICE_DECADES);
        const marks = [-90, -60, -30, 0, 30, 60, 90].map((at) => ({ at, text: `${Math.abs(at)}°` }));
        const x = { low: -90, high: 90, ticks: marks, label: "viewer, from the normal" };
        const { px, py, inside, parts } = axes(width, height, x, { ...y, label: "f [1/sr]" });
        inside.append(
            rule(px(angle), 0, px(angle), height, { stroke: "var(--quiet)", "stroke-dasharray": "1 3" }),
            svg("path", { d: "M-5 0H5L0 9Z", fill: "var(--text)", transform: `translate(${px(-angle)})` }),
            ...series.map((one) => curve(Array.from(one.y, (f, i) => [px(one.x[i]), py(of(f))]), one)),
        );
        return { height, parts };
    },
});
