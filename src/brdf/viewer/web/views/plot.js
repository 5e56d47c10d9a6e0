// Figures of the page: drawings of lines that follow the page's colours and size, with a legend and a text for those
// who do not see them.

const SPACE = "http://www.w3.org/2000/svg";

/** Distinct with any colour vision, and 3 : 1 at least on a light and on a dark page. Reference: Okabe2008. */
export const COLOURS = ["#0d7ccb", "#d55e00", "#0a9367", "#b0569a"];

/** Second key to the curves. */
export const DASHES = ["", "7 3", "2 3", "9 3 2 3"];

export const CHANNELS = [
    { name: "red", colour: COLOURS[1], dash: DASHES[1] },
    { name: "green", colour: COLOURS[2], dash: DASHES[0] },
    { name: "blue", colour: COLOURS[0], dash: DASHES[2] },
];

/** Of materials A and B. */
export const PAIR = [
    { colour: "var(--series-a)", dash: "" },
    { colour: "var(--series-b)", dash: "7 3" },
];

/** @typedef {{name: string, colour: string, dash: string}} Style */

/**
 * An element of a drawing with attributes and children.
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 * @param {...(Node | string)} children
 */
export function svg(tag, attributes = {}, ...children) {
    const made = document.createElementNS(SPACE, tag);
    for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
    made.append(...children);
    return /** @type {SVGElement} */ (made);
}

/**
 * @param {string | Node} content
 * @param {number} x
 * @param {number} y
 * @param {"start" | "middle" | "end"} anchor
 * @param {Record<string, string | number>} more
 */
export function text(content, x, y, anchor = "middle", more = {}) {
    return svg("text", { x, y, "text-anchor": anchor, fill: "var(--quiet)", "font-size": 11, ...more }, content);
}

/** @param {number} x1 @param {number} y1 @param {number} x2 @param {number} y2 @param {Record<string, any>} more */
export function rule(x1, y1, x2, y2, more = {}) {
    return svg("line", { x1, y1, x2, y2, stroke: "var(--line)", ...more });
}

/**
 * A curve through points; it has a gap where one is not finite.
 * @param {number[][]} points
 * @param {{colour: string, dash: string}} style
 */
export function curve(points, { colour, dash }) {
    let d = "";
    let inside = false;
    for (const [x, y] of points) {
        const known = Number.isFinite(x) && Number.isFinite(y);
        if (known) d += `${inside ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`;
        inside = known;
    }
    const given = { d, fill: "none", stroke: colour, "stroke-width": 2, "stroke-linejoin": "round" };
    return svg("path", dash ? { ...given, "stroke-dasharray": dash } : given);
}

/** What the curves of a figure mean. */
export function legend() {
    const list = document.createElement("ul");
    list.className = "legend";
    const show = (/** @type {Style[]} */ styles) => {
        list.hidden = styles.length === 0;
        list.replaceChildren(...styles.map(({ name, ...style }) => {
            const item = document.createElement("li");
            const sample = curve([[0, 4], [24, 4]], style);
            item.append(svg("svg", { width: 24, height: 8, "aria-hidden": "true" }, sample), name);
            return item;
        }));
    };
    return { element: list, show };
}

/** A drawing within the page, made anew when its width changes. */
export class Figure {
    /**
     * @param {HTMLElement} container
     * @param {(width: number) => {height: number, parts: Node[]}} draw
     */
    constructor(container, draw) {
        this.draw = draw;
        this.svg = svg("svg", { role: "img", display: "block", width: "100%" });
        this.legend = legend();
        this.element = document.createElement("figure");
        this.element.append(this.svg, this.legend.element);
        container.append(this.element);
        this.width = 0;
        this.observer = new ResizeObserver(() => {
            if (this.element.clientWidth !== this.width) this.redraw();
        });
        this.observer.observe(this.element);
    }

    /**
     * @param {string} description all that matters, in a sentence
     * @param {Style[]} styles of the legend
     */
    show(description, styles) {
        this.svg.setAttribute("aria-label", description);
        this.legend.show(styles);
        this.redraw();
    }

    redraw() {
        this.width = this.element.clientWidth;
        if (!this.width) return;
        const { height, parts } = this.draw(this.width);
        this.svg.setAttribute("viewBox", `0 0 ${this.width} ${height}`);
        this.svg.setAttribute("height", String(height));
        this.svg.replaceChildren(...parts);
    }

    destroy() {
        this.observer.disconnect();
        this.element.remove();
    }
}

/**
 * Of a figure with axes.
 * @param {number} width
 */
export function heightOf(width) {
    return Math.round(Math.min(320, 0.62 * width + 40));
}

/**
 * @typedef {{low: number, high: number, ticks: {at: number, text: string}[], label: string}} Axis
 */

/**
 * A frame of two axes, and where a point of theirs lies in it; curves belong into `inside`, which cuts them off.
 * @param {number} width
 * @param {number} height
 * @param {Axis} x
 * @param {Axis} y
 */
export function axes(width, height, x, y) {
    const longest = Math.max(...y.ticks.map((tick) => tick.text.length));
    const [left, right, top, bottom] = [26 + 6.5 * longest, width - 10, 8, height - 40];
    const px = (/** @type {number} */ value) => ((value - x.low) / (x.high - x.low)) * (right - left);
    const py = (/** @type {number} */ value) => (1 - (value - y.low) / (y.high - y.low)) * (bottom - top);
    const inside = svg("svg", { x: left, y: top, width: right - left, height: bottom - top });
    const parts = [
        ...y.ticks.flatMap(({ at, text: label }) => [
            rule(left, top + py(at), right, top + py(at)), text(label, left - 6, top + py(at) + 4, "end"),
        ]),
        ...x.ticks.flatMap(({ at, text: label }) => [
            rule(left + px(at), top, left + px(at), bottom), text(label, left + px(at), bottom + 16),
        ]),
        text(x.label, (left + right) / 2, height - 6),
        text(y.label, 0, 0, "middle", { transform: `translate(11 ${(top + bottom) / 2}) rotate(-90)` }),
        inside,
    ];
    return { px, py, inside, parts, left, right, top, bottom };
}
