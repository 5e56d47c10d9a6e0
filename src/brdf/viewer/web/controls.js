// Controls that read and write one value each, and follow when it is changed elsewhere.

import { encode, linear } from "./colour.js";
import { element } from "./element.js";

/**
 * @typedef {{element: HTMLElement, refresh: () => void}} Control
 * @typedef {{low: number, high: number, log?: boolean, unit?: string}} Scale
 */

const SLIDER_STEPS = 500;

/** @param {number} value with three digits @returns {string} */
export function typeable(value) {
    const size = Math.abs(value);
    if (size && (size < 1e-3 || size >= 1e5)) return value.toExponential(1).replace("e+", "e");
    return String(Number(value.toPrecision(size >= 100 ? 4 : 3)));
}

/**
 * A number: a slider, logarithmic where asked, and the number itself to type.
 * @param {{label: string, doc?: string, scale: Scale, read: () => number, write: (value: number) => void}} given
 * @returns {Control}
 */
export function slider({ label, doc, scale, read, write }) {
    const { low, high, log, unit = "" } = scale;
    const position = (/** @type {number} */ v) =>
        SLIDER_STEPS * (log ? Math.log(Math.max(v, low) / low) / Math.log(high / low) : (v - low) / (high - low));
    const value = (/** @type {number} */ p) =>
        log ? low * (high / low) ** (p / SLIDER_STEPS) : low + ((high - low) * p) / SLIDER_STEPS;
    const range = element("input", {
        type: "range", min: 0, max: SLIDER_STEPS, step: 1, "aria-label": label, title: doc,
        oninput: () => write(Number(value(Number(range.value)).toPrecision(4))),
    });
    const typed = element("input", {
        type: "text", inputmode: "decimal", class: "number", "aria-label": `${label}, value`,
        onchange: () => {
            const number = Number(typed.value.replace(unit.trim(), "").replace(",", ".").trim() || NaN);
            if (Number.isFinite(number)) write(number);
            show();
        },
        onblur: () => show(),
        onfocus: () => typed.select(),
    });
    const show = () => void (typed.value = typeable(read()) + unit);
    const refresh = () => {
        const now = read();
        range.value = String(Math.round(position(now)));
        range.style.setProperty("--filled", `${Math.min(100, Math.max(0, position(now) / SLIDER_STEPS * 100))}%`);
        range.setAttribute("aria-valuetext", typeable(now) + unit);
        if (document.activeElement !== typed) show();  // not over what is being typed
    };
    return { element: element("div", { class: "row slider", title: doc }, caption(label), range, typed), refresh };
}

/** @param {string} label */
function caption(label) {
    return element("span", { class: "label", "aria-hidden": "true" }, label);
}

/**
 * One of several, all in sight.
 * @param {{label: string, options: () => [string, string][], read: () => string, write: (value: string) => void,
 *     hidden?: boolean}} given `options`: value and text of each
 * @returns {Control}
 */
export function choice({ label, options, read, write, hidden }) {
    const group = element("div", { class: "choice", role: "radiogroup", "aria-label": label });
    const step = (/** @type {KeyboardEvent} */ event) => {
        const move = { ArrowRight: 1, ArrowDown: 1, ArrowLeft: -1, ArrowUp: -1 }[event.key];
        if (!move) return;
        event.preventDefault();
        const values = options().map(([value]) => value);
        write(values[(values.indexOf(read()) + move + values.length) % values.length]);
        /** @type {HTMLElement | null} */ (group.querySelector("[aria-checked=true]"))?.focus();
    };
    let shown = "";
    const refresh = () => {
        const now = options();
        if (shown !== String(now)) {
            shown = String(now);
            group.replaceChildren(...now.map(([value, text]) => element("button", {
                type: "button", role: "radio", value, onclick: () => write(value), onkeydown: step,
            }, text)));
        }
        for (const button of group.querySelectorAll("button")) {
            const checked = button.value === read();
            button.setAttribute("aria-checked", String(checked));
            button.tabIndex = checked ? 0 : -1;
        }
    };
    const row = element("div", { class: hidden ? "row wide" : "row" }, hidden ? null : caption(label), group);
    return { element: row, refresh };
}

/**
 * One of several, in a list that opens.
 * @param {{label: string, options: () => [string, string][], read: () => string, write: (value: string) => void}} given
 * @returns {Control}
 */
export function select({ label, options, read, write }) {
    const list = element("select", { "aria-label": label, onchange: () => write(list.value) });
    let shown = "";
    const refresh = () => {
        const now = options();
        if (shown !== String(now)) {
            shown = String(now);
            list.replaceChildren(...now.map(([value, text]) => element("option", { value }, text)));
        }
        list.value = read();
    };
    return { element: element("div", { class: "row" }, caption(label), list), refresh };
}

/**
 * @param {{label: string, read: () => boolean, write: (value: boolean) => void}} given
 * @returns {Control}
 */
export function toggle({ label, read, write }) {
    const box = element("input", {
        type: "checkbox", role: "switch", "aria-label": label, onchange: () => write(box.checked),
    });
    const refresh = () => void (box.checked = read());
    return { element: element("label", { class: "row toggle" }, caption(label), box), refresh };
}

/** @param {ArrayLike<number>} colour linear @returns {string} */
export function hexadecimal(colour) {
    const part = (/** @type {number} */ x) =>
        Math.round(255 * encode(x)).toString(16).padStart(2, "0");
    return `#${part(colour[0])}${part(colour[1])}${part(colour[2])}`;
}

/**
 * A linear colour with channels in [0, 1].
 * @param {{label: string, doc?: string, read: () => ArrayLike<number>, write: (value: number[]) => void,
 *     bare?: boolean}} given
 * @returns {Control}
 */
export function colour({ label, doc, read, write, bare }) {
    const well = element("input", {
        type: "color", "aria-label": label, title: doc,
        oninput: () => write([1, 3, 5].map((at) => linear(parseInt(well.value.slice(at, at + 2), 16) / 255))),
    });
    const text = element("span", { class: "number", "aria-hidden": "true" });
    const refresh = () => {
        well.value = hexadecimal(read());
        text.textContent = Array.from(read(), (x) => x.toFixed(2)).join(" ");
    };
    if (bare) return { element: well, refresh };
    return { element: element("div", { class: "row colour", title: doc }, caption(label), well, text), refresh };
}

/**
 * A part of the panel that folds.
 * @param {string} title
 * @param {Control[]} controls
 * @param {{open?: boolean, action?: HTMLElement}} options `action`: a button beside the title
 * @returns {Control}
 */
export function section(title, controls, { open = true, action } = {}) {
    const body = element("div", { class: "body" }, ...controls.map((control) => control.element));
    const made = element("details", { open }, element("summary", {}, element("h2", {}, title)), body);
    if (action) made.append(action);
    return { element: made, refresh: () => controls.forEach((control) => control.refresh()) };
}

/**
 * Controls that are made anew when what they are made of changes.
 * @param {() => string} key
 * @param {() => Control[]} make
 * @returns {Control}
 */
export function changing(key, make) {
    const place = element("div", { class: "changing" });
    let made = /** @type {Control[]} */ ([]);
    let shown = "";
    const refresh = () => {
        if (key() !== shown) {
            shown = key();
            made = make();
            place.replaceChildren(...made.map((control) => control.element));
        }
        made.forEach((control) => control.refresh());
    };
    return { element: place, refresh };
}
