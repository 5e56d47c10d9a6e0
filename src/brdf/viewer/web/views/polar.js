// Lobes in the plane of incidence, as polar curves.

import { DEGREE, inPlane, luminances, SEEN, short } from "./numbers.js";
import { COLOURS, curve, DASHES, PAIR, rule, svg, text } from "./plot.js";
import { curveView, logarithmic, scaled } from "./view.js";

/** Degrees from the normal, of the light. */
const ANGLES = [0, 30, 60, 80];

/** The same where two materials share the figure. */
const COMPARED_ANGLES = [30, 70];

const POLAR_DECADES = 5;

/** Room for the names of the angles around the half disc. */
const EDGE = 30;

export const polar = curveView({
    id: "polar",
    title: "Lobes",
    options: { log: true },
    controls: (chosen) => [logarithmic(chosen)],
    series({ evaluator }, materials, names) {
        const several = materials.length > 1;
        return materials.flatMap((material, m) => (several ? COMPARED_ANGLES : ANGLES).map((angle, a) => ({
            name: several ? names[m] : `${angle}°`,
            angle,
            ...(several ? PAIR[m] : { colour: COLOURS[a], dash: DASHES[a] }),
            x: SEEN,
            y: luminances(inPlane(evaluator, material, angle, SEEN)),
        })));
    },
    what: () => "Lobes in the plane of incidence, luminance of f [1/sr],",
    told({ y, angle }) {
        const top = y.indexOf(Math.max(...y));
        return `light at ${angle}°, largest ${short(y[top])} at ${Math.round(SEEN[top])}°`;
    },
    drawn(width, series, { log }) {
        const radius = Math.min(width / 2 - EDGE, 240);
        const [x, y] = [width / 2, radius + EDGE - 6];
        const { low, high, of, ticks: rings } = scaled(series, log, POLAR_DECADES);
        const part = (/** @type {number} */ on) => Math.max(0, (on - low) / (high - low)) || 0;
        /** @type {(angle: number, share?: number) => [number, number]} */
        const place = (angle, share = 1) => [
            x + radius * share * Math.sin(angle * DEGREE), y - radius * share * Math.cos(angle * DEGREE),
        ];
        const arc = (/** @type {number} */ r) => svg("path", {
            d: `M${x - r} ${y}A${r} ${r} 0 0 1 ${x + r} ${y}`, fill: "none", stroke: "var(--line)",
        });
        const parts = [
            arc(radius), ...rings.map(({ at }) => arc(radius * part(at))),
            ...[-90, -60, -30, 0, 30, 60, 90].flatMap((angle) => {
                const [px, py] = place(angle);
                const [dx, dy] = [16 * Math.sin(angle * DEGREE), 4 - 10 * Math.cos(angle * DEGREE)];
                return [rule(x, y, px, py), text(`${Math.abs(angle)}°`, px + dx, py + dy)];
            }),
            ...rings.slice(1).map(({ at, text: label }) => text(label, x + radius * part(at), y + 15)),
            ...series.map((one) => curve(Array.from(one.y, (f, i) => place(one.x[i], part(of(f)))), one)),
            ...series.map(({ angle = 0, name, colour }) => svg("path", {
                d: "M-5 -5H5L0 5Z", fill: name === `${angle}°` ? colour : "var(--text)",
                transform: `translate(${place(-angle)}) rotate(${-angle})`,
            })),
            text("f [1/sr]", x + radius, y + 30, "end"),
            text("▾ light", x - radius, y + 30, "start"),
        ];
        return { height: y + 38, parts };
    },
});
