// What the views share: choices above, figures below, and the numbers that they show.

import { slider, toggle } from "../controls.js";
import { element } from "../element.js";
import { channelOf, decades, luminances, powers, short, ticks } from "./numbers.js";
import { CHANNELS, Figure, PAIR } from "./plot.js";

/**
 * @typedef {import("../material.js").Material} Material
 * @typedef {import("../controls.js").Control} Control
 * @typedef {{evaluator: import("../evaluate.js").Evaluator, materials: () => Material[], theme: () => string}} Context
 *
 * A curve of a figure: its numbers over those of `x`, and how it is drawn.
 * @typedef {import("./plot.js").Style & {x: ArrayLike<number>, y: Float64Array, angle?: number}} Series
 *
 * @typedef {Record<string, any>} Options
 * @typedef {{options: Options, change: (some: Options) => void}} Chosen
 */

/** Largest angle of the light in a view [degrees]. */
const LOWEST_LIGHT = 85;

/** @type {WeakMap<object, Map<string, Options>>} */
const kept = new WeakMap();

/**
 * Choices of a view, the same ones when it is shown again, and what changes them.
 * @param {Context} context
 * @param {string} id
 * @param {Options} first as they are at first
 * @param {() => void} update
 * @returns {Chosen}
 */
export function chosen({ evaluator }, id, first, update) {
    const all = kept.get(evaluator) ?? new Map();
    kept.set(evaluator, all);
    if (!all.has(id)) all.set(id, { ...first });
    const options = all.get(id);
    const change = (/** @type {Options} */ some) => {
        Object.assign(options, some);
        update();
    };
    return { options, change };
}

/**
 * Controls above a figure; gives what makes them follow.
 * @param {HTMLElement} container
 * @param {Control[]} controls
 */
export function choices(container, controls) {
    if (controls.length) {
        container.append(element("div", { class: "choices" }, ...controls.map((control) => control.element)));
    }
    return () => controls.forEach((control) => control.refresh());
}

/** @param {Chosen} choosing */
export function logarithmic({ options, change }) {
    return toggle({ label: "Logarithmic", read: () => options.log, write: (log) => change({ log }) });
}

/**
 * Whole degrees.
 * @param {Chosen} choosing
 * @param {string} key of the options
 * @param {string} label
 * @param {string} doc
 */
export function degrees({ options, change }, key, label, doc, high = LOWEST_LIGHT) {
    const write = (/** @type {number} */ value) => change({ [key]: Math.min(high, Math.max(0, Math.round(value))) });
    return slider({ label, doc, scale: { low: 0, high, unit: "°" }, read: () => options[key], write });
}

/** @param {Chosen} choosing */
export function lightAngle(choosing) {
    return degrees(choosing, "angle", "Light", "Angle of the light from the normal");
}

/**
 * The names of the materials for a legend: letters before them where there are two.
 * @param {Material[]} materials
 */
export function namesOf(materials) {
    return materials.map(({ name }, i) => (materials.length > 1 ? `${"AB"[i]} ${name}` : name));
}

/**
 * Curves of values: the channels of one material, the luminances of two.
 * @param {string[]} names
 * @param {Float32Array[]} values RGBA of each material
 * @param {ArrayLike<number>} x
 * @returns {Series[]}
 */
export function curvesOf(names, values, x) {
    if (values.length > 1) return values.map((list, m) => ({ name: names[m], ...PAIR[m], x, y: luminances(list) }));
    return CHANNELS.map((channel, c) => ({ ...channel, x, y: channelOf(values[0], c) }));
}

/**
 * From values to places on an axis, its ends, and its marks.
 * @param {Series[]} series
 * @param {boolean} log logarithmic, over at most so many powers of ten
 * @param {number} most
 */
export function scaled(series, log, most) {
    const lists = series.map(({ y }) => y);
    if (log) {
        const { low, high } = decades(lists, most);
        const marks = powers(low, high, high - low > 4 ? 2 : 1);
        const of = (/** @type {number} */ value) => (value > 0 ? Math.max(Math.log10(value), low - 1) : NaN);
        return { low, high, ticks: marks.map(({ at, text }) => ({ at: Math.log10(at), text })), of };
    }
    const marks = ticks(Math.max(...lists.map((list) => Math.max(...list)))).map((at) => ({ at, text: short(at) }));
    return { low: 0, high: marks[marks.length - 1].at, ticks: marks, of: (/** @type {number} */ value) => value };
}

/**
 * A view of curves.
 * @typedef {object} Kind
 * @property {string} id
 * @property {string} title
 * @property {Options} [options] as they are at first
 * @property {(choosing: Chosen) => Control[]} [controls]
 * @property {(context: Context, materials: Material[], names: string[], options: Options) => Series[]} series
 * @property {(options: Options) => string} what the curves are
 * @property {(series: Series) => string} told of each curve, in numbers
 * @property {(width: number, series: Series[], options: Options) => {height: number, parts: Node[]}} drawn
 */

/** @param {Kind} kind */
export function curveView(kind) {
    const create = (/** @type {HTMLElement} */ container, /** @type {Context} */ context) => {
        const choosing = chosen(context, kind.id, kind.options ?? {}, () => update());
        const { options } = choosing;
        /** @type {Series[]} */
        let series = [];
        const refresh = choices(container, kind.controls?.(choosing) ?? []);
        const figure = new Figure(container, (width) => kind.drawn(width, series, options));
        const update = () => {
            const materials = context.materials();
            const names = namesOf(materials);
            series = kind.series(context, materials, names, options);
            refresh();
            const legend = series.filter(({ name }, i) => series.findIndex((other) => other.name === name) === i);
            const told = series.map((one) => `${one.name}: ${kind.told(one)}`);
            figure.show(`${kind.what(options)} of ${names.join(" and ")}. ${told.join("; ")}.`, legend);
        };
        return { options, update, data: () => series, destroy: () => figure.destroy() };
    };
    return { id: kind.id, title: kind.title, create };
}
