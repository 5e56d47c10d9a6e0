// What the views share: choices above, a figure below, and the numbers that it shows.

import { element } from "../element.js";

/**
 * @typedef {import("../material.js").Material} Material
 * @typedef {import("../controls.js").Control} Control
 * @typedef {{evaluator: import("../evaluate.js").Evaluator, materials: () => Material[], theme: () => string}} Context
 *
 * A curve of a figure: its numbers over those of `x`, and how it is drawn.
 * @typedef {import("./plot.js").Style & {x: ArrayLike<number>, y: ArrayLike<number>}} Series
 */

/** @type {WeakMap<object, Map<string, any>>} */
const kept = new WeakMap();

/**
 * Choices of a view, the same ones when it is shown again.
 * @template {Record<string, any>} Options
 * @param {Context} context
 * @param {string} id
 * @param {Options} options as they are at first
 * @returns {Options}
 */
export function remembered({ evaluator }, id, options) {
    const all = kept.get(evaluator) ?? new Map();
    kept.set(evaluator, all);
    if (!all.has(id)) all.set(id, options);
    return all.get(id);
}

/**
 * Controls in a row above a figure.
 * @param {HTMLElement} container
 * @param {Control[]} controls
 */
export function choices(container, controls) {
    container.append(element("div", { class: "choices" }, ...controls.map((control) => control.element)));
    for (const control of controls) control.refresh();
    return () => controls.forEach((control) => control.refresh());
}

/**
 * The names of the materials for a legend: letters before them where there are two.
 * @param {Material[]} materials
 */
export function namesOf(materials) {
    return materials.map((material, i) => (materials.length > 1 ? `${"AB"[i]} ${material.name}` : material.name));
}
