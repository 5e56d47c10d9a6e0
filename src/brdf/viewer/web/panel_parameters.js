// Sliders and colours made from what a material declares.

import { colour, slider } from "./controls.js";
import { element } from "./element.js";
import { within } from "./material.js";

/**
 * @typedef {import("./viewer.js").Viewer} Viewer
 * @typedef {import("./payload.js").Parameter} Parameter
 * @typedef {import("./controls.js").Control} Control
 * @typedef {import("./controls.js").Scale} Scale
 */

const DECADES = 100;  // bounds farther apart than this get a logarithmic scale
const CHANNEL_NAMES = ["R", "G", "B"];

/**
 * @param {Viewer} viewer
 * @param {number} slot
 * @returns {Control[]}
 */
export function parameterControls(viewer, slot) {
    const declared = viewer.slots.at(slot).parameters.filter(({ doc }) => doc);  // not how a table is encoded
    return declared.map((parameter) => {
        const { name, size, unit } = parameter;
        const doc = unit && unit !== "1" ? `${parameter.doc} [${unit}]` : parameter.doc;
        const read = () => [viewer.slots.at(slot).values[name]].flat();
        const given = { label: name.replaceAll("_", " "), doc, scale: scaleOf(parameter) };
        const change = (/** @type {number[]} */ value) => {
            const values = { ...viewer.state.parameters[slot], [name]: within(parameter, value) };
            viewer.set({ parameters: viewer.state.parameters.with(slot, values) });
        };
        if (size === 1) return slider({ ...given, read: () => read()[0], write: (value) => change([value]) });
        if (parameter.low === 0 && parameter.high === 1) return colour({ ...given, read, write: change });
        return channelSliders(given, read, change);
    });
}

/**
 * One slider for all channels, and one for each below it when unfolded.
 * @param {{label: string, doc?: string, scale: Scale}} given
 * @param {() => number[]} read
 * @param {(value: number[]) => void} write
 * @returns {Control}
 */
function channelSliders(given, read, write) {
    const mean = () => read().reduce((sum, value) => sum + value) / CHANNEL_NAMES.length;
    const { low } = given.scale;
    const all = slider({
        ...given, read: mean,
        write: (value) => {
            const now = mean();
            write(read().map((x) => (low < 0 || now === 0 ? x + value - now : (x * value) / now)));
        },
    });
    const each = CHANNEL_NAMES.map((channel, k) => slider({
        ...given, label: `${given.label} ${channel}`, read: () => read()[k],
        write: (value) => write(read().with(k, value)),
    }));
    const rows = each.map((control) => control.element);
    const body = element("div", { class: "changing channels", hidden: true }, ...rows);
    const unfold = element("button", {
        type: "button", class: "unfold", "aria-expanded": "false", "aria-label": `Channels of ${given.label}`,
        onclick: () => {
            body.hidden = !body.hidden;
            unfold.setAttribute("aria-expanded", String(!body.hidden));
        },
    });
    all.element.prepend(unfold);
    const refresh = () => [all, ...each].forEach((control) => control.refresh());
    return { element: element("div", { class: "changing" }, all.element, body), refresh };
}

/**
 * The bounds of a slider: the declared ones, or where there are none or they are far away, some around the value.
 * @param {Parameter} parameter
 * @returns {Scale}
 */
export function scaleOf({ low, high, value }) {
    const largest = Math.max(...[value].flat().map(Math.abs), 1e-6);
    const known = high !== null && high !== undefined && high < 1e4;
    const most = known ? /** @type {number} */ (high) : Math.max(1, 4 * largest, low ? 10 * low : 0);
    const least = low ?? -most;
    const log = least > 0 && most / least >= DECADES;
    return { low: least, high: most, log };
}
