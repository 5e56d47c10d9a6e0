// Lobes in the plane of incidence, as polar curves.

import { decades, DEGREE, inPlane, luminances, powers, SEEN, short, ticks } from "./numbers.js";
import { COLOURS, curve, DASHES, PAIR, rule, svg, text } from "./plot.js";
import { curveView, logarithmic } from "./view.js";

/** Degrees from the normal, of the light. */
const ANGLES = [0, 30, 60, 80];

/** The same where two materials share the figure. */
const COMPARED_ANGLES = [30, 70];

const DECADES = 5;

/** Room for the names of the angles around the half disc. */
const MARGIN = 30;

/**
 * From f [1/sr] to a share of the radius, and the rings of the disc.
 * @param {import("./view.js").Series[]} series
 * @param {boolean} log
 * @returns {{share: (f: number) => number, rings: {at: number, text: string}[]}}
 */
function scaled(series, log) {
    const lists = series.map(({ y }) => y);
    if (log) {
        const { low, high } = decades(lists, DECADES);
        const rings = powers(low, high, high - low > 4 ? 2 : 1).slice(1);
        return { rings, share: (f) => (f > 0 ? Math.max(0, (Math.log10(f) - low) / (high - low)) : 0) };
    }
    const largest = Math.max(1e-9, ...lists.map((list) => Math.max(...list)));
    const rings = ticks(largest, 3).filter((at) => at > 0 && at <= largest).map((at) => ({ at, text: short(at) }));
    return { rings, share: (f) => f / largest };
}

export const view = curveView({
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
        const radius = Math.min(width / 2 - MARGIN, 240);
        const [x, y] = [width / 2, radius + MARGIN - 6];
        const { rings, share } = scaled(series, log);
        /** @type {(angle: number, part?: number) => [number, number]} */
        const place = (angle, part = 1) => [
            x + radius * part * Math.sin(angle * DEGREE), y - radius * part * Math.cos(angle * DEGREE),
        ];
        const arc = (/** @type {number} */ r) => svg("path", {
            d: `M${x - r} ${y}A${r} ${r} 0 0 1 ${x + r} ${y}`, fill: "none", stroke: "var(--grid)",
        });
        const parts = [
            arc(radius), ...rings.map(({ at }) => arc(radius * share(at))),
            ...[-90, -60, -30, 0, 30, 60, 90].flatMap((angle) => {
                const [px, py] = place(angle);
                const [dx, dy] = [16 * Math.sin(angle * DEGREE), 4 - 10 * Math.cos(angle * DEGREE)];
                return [rule(x, y, px, py), text(`${Math.abs(angle)}°`, px + dx, py + dy)];
            }),
            ...rings.map((ring) => text(ring.text, x + radius * share(ring.at), y + 15)),
            ...series.map((one) => curve(Array.from(one.y, (f, i) => place(one.x[i], share(f))), one)),
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
