// Elements of the page from one expression.

/**
 * An element with attributes and children. Attributes that begin with "on" are listeners; false and undefined leave
 * one out.
 * @template {keyof HTMLElementTagNameMap} Tag
 * @param {Tag} tag
 * @param {Record<string, any>} attributes
 * @param {...(Node | string | null | undefined | false)} children
 * @returns {HTMLElementTagNameMap[Tag]}
 */
export function element(tag, attributes = {}, ...children) {
    const made = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
        if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
        else if (value !== false && value !== undefined && value !== null) {
            made.setAttribute(name, value === true ? "" : value);
        }
    }
    for (const child of children) if (child) made.append(child);
    return made;
}

/** Strokes in a square of 20 units. @type {Record<string, string>} */
const ICONS = {
    save: "M10 3v9m-3.5-3.5L10 12l3.5-3.5M4 13v3h12v-3",
    open: "M10 12V3M6.5 6.5 10 3l3.5 3.5M4 13v3h12v-3",
    theme: "M10 3a7 7 0 1 0 0 14zM10 3a7 7 0 0 1 0 14",
    help: "M7.5 7.5a2.5 2.5 0 1 1 3.6 2.2c-.8.4-1.1.9-1.1 1.8M10 14.4v.2",
    panel: "M3.5 4.5h13v11h-13zM12 4.5v11",
    close: "M5.5 5.5l9 9m0-9l-9 9",
    reset: "M5 6.5A6 6 0 1 1 4 10M5 3v3.5h3.5",
    add: "M10 4.5v11M4.5 10h11",
    light: "M10 2.5v2m0 11v2m7.5-7.5h-2m-11 0h-2m12.8-5.3-1.4 1.4m-7.8 7.8-1.4 1.4m10.6 0-1.4-1.4M6.1 6.1 4.7 4.7" +
        "M13.2 10a3.2 3.2 0 1 1-6.4 0 3.2 3.2 0 0 1 6.4 0z",
    view: "M3.5 15.5c3 0 3-9 6.5-9s3.5 9 6.5 9M3 16.5h14",
};

/** @param {string} name of `ICONS` */
export function icon(name) {
    const space = "http://www.w3.org/2000/svg";
    const svg = document.createElementNS(space, "svg");
    const path = document.createElementNS(space, "path");
    svg.setAttribute("viewBox", "0 0 20 20");
    svg.setAttribute("aria-hidden", "true");
    path.setAttribute("d", ICONS[name]);
    svg.append(path);
    return svg;
}

/**
 * A button that is an icon; its label is what it is called and what hovering shows.
 * @param {string} name
 * @param {string} label
 * @param {(event: MouseEvent) => void} act
 * @param {Record<string, any>} attributes
 */
export function iconButton(name, label, act, attributes = {}) {
    const given = { type: "button", class: "icon", "aria-label": label, title: label, onclick: act, ...attributes };
    return element("button", given, icon(name));
}
