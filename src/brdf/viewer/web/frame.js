// What stands around and over the picture: title, tools, panel, drawer, labels, messages.

import { typeable } from "./controls.js";
import { Drop } from "./drop.js";
import { element, iconButton } from "./element.js";
import { helpDialog, KEYS_TEXT } from "./help.js";
import { panel } from "./panel.js";
import { NAMES } from "./slots.js";
import { COMPARISONS } from "./state.js";

/** @typedef {import("./viewer.js").Viewer} Viewer */

/** Below this width of the page the panel is a sheet at its foot. */
const NARROW = 640;
const MESSAGE_TIME = 8000;

/** @param {Viewer} viewer */
export function frame(viewer) {
    return new Frame(viewer);
}

class Frame {
    /** @param {Viewer} viewer */
    constructor(viewer) {
        this.viewer = viewer;
        this.panel = panel(viewer);
        this.help = helpDialog();
        this.labels = NAMES.map(() => element("span", { class: "name" }));
        this.title = element("h1", {});
        this.about = element("p", { class: "about" });
        this.message = element("div", { class: "message", role: "status" });
        this.fold = iconButton("panel", "Panel (p)", () => this.toggle());
        this.aim = iconButton("light", "Move the light (l, or Shift and drag)", () => this.toggleLight());
        const tools = element("div", { class: "tools", role: "toolbar", "aria-label": "Tools" },
            this.aim,
            iconButton("open", "Open a file (o)", () => this.drop.choose()),
            iconButton("save", "Save a PNG (s)", () => this.save()),
            iconButton("theme", "Dark or light (d)", () => this.switchTheme()),
            iconButton("help", "Help (?)", () => this.help.showModal()),
            this.fold);
        this.side = element("aside", { class: "panel", "aria-label": "Settings" }, this.panel.element);
        this.drop = new Drop(viewer);
        const { canvas, handles, drawer } = viewer;
        const title = element("div", { class: "title" }, this.title, this.about);
        this.element = element("div", { class: "viewer" },
            element("div", { class: "picture-area" }, canvas, handles.element, viewer.divider.element, ...this.labels),
            element("header", { class: "head" }, title, tools),
            drawer.element, this.side, this.message, this.help,
            element("p", { id: canvas.getAttribute("aria-describedby"), class: "unseen" }, KEYS_TEXT));
        this.drop.listen(this.element);
        if (viewer.root.clientWidth && viewer.root.clientWidth < NARROW) this.side.classList.add("folded");
        this.timer = 0;
    }

    get narrow() {
        return this.viewer.root.clientWidth < NARROW;
    }

    /** Shows everything as the state says. */
    refresh() {
        const { viewer } = this;
        if (this.narrow && viewer.state.view) this.side.classList.add("folded");  // there is room for one of the two
        const materials = viewer.materials();
        const names = new Set(materials.map((material) => material.name));
        this.title.textContent = this.title.title = [...names].join(" · ");
        const first = viewer.slots.at(0).source;
        const about = [first.kind, size(first.nbytes)].filter(Boolean).join(" · ");
        this.about.textContent = materials.length > 1 ? "" : about;
        viewer.canvas.setAttribute("aria-label", `${[...names].join(" beside ")} on a ${viewer.state.mesh}`);
        this.panel.refresh();
        this.aim.setAttribute("aria-pressed", String(viewer.lighting));
        this.fold.setAttribute("aria-expanded", String(!this.side.classList.contains("folded")));
    }

    /**
     * Places the names of what is compared.
     * @param {import("./layout.js").Pane[]} panes
     */
    arrange(panes) {
        const { slots, state: { compare, divider } } = this.viewer;
        const [a, b] = this.labels;
        this.labels.forEach((label, slot) => (label.textContent = `${NAMES[slot]}  ${slots.at(slot).name}`));
        a.hidden = b.hidden = compare !== "split" && compare !== "side";
        if (compare === "difference") {
            a.hidden = false;
            a.textContent = `|A − B| × ${typeable(this.viewer.state.gain)}`;
        }
        if (a.hidden) return;
        const { clientWidth: width, clientHeight: height } = this.viewer.canvas;
        const free = this.free({ width, height });
        let line = free.x + free.width;
        if (compare === "side") line = panes[1].place.x;
        if (compare === "split") line = divider * width;
        const foot = `${height - free.y - free.height + 16}px`;
        a.style.bottom = b.style.bottom = foot;
        a.style.right = `${width - line + 12}px`;
        b.style.left = `${line + 12}px`;
        a.style.maxWidth = `${line - free.x - 24}px`;
        b.style.maxWidth = `${free.x + free.width - line - 24}px`;
    }

    /**
     * What of the canvas nothing covers.
     * @param {{width: number, height: number}} size
     * @returns {import("./camera.js").Rectangle}
     */
    free({ width, height }) {
        const at = { left: 0, top: 0, right: width, bottom: height };
        let above = height;  // the drawer
        const canvas = this.viewer.canvas.getBoundingClientRect();
        for (const cover of [this.side, this.viewer.drawer.element]) {
            if (!cover.isConnected || cover.hidden || cover.classList.contains("folded")) continue;
            const box = cover.getBoundingClientRect();
            if (!box.width) continue;
            if (this.narrow) at.bottom = Math.min(at.bottom, box.top - canvas.top);
            else if (cover === this.side) at.right = Math.min(at.right, box.left - canvas.left);
            else [at.left, above] = [box.right - canvas.left, box.top - canvas.top];
        }
        if (at.right - at.left < 200) Object.assign(at, { left: 0, bottom: Math.min(at.bottom, above) });
        if (at.bottom - at.top < 80) Object.assign(at, { bottom: height });
        const top = Math.min(at.top + 48, at.bottom - 40);
        return { x: at.left, y: top, width: at.right - at.left, height: at.bottom - top };
    }

    toggle() {
        const folded = this.side.classList.toggle("folded");
        if (!folded && this.narrow) this.viewer.set({ view: null });
        this.viewer.refresh();
    }

    toggleLight() {
        this.viewer.lighting = !this.viewer.lighting;
        this.refresh();
    }

    switchTheme() {
        this.viewer.root.dataset.theme = this.viewer.theme() === "dark" ? "light" : "dark";
        this.viewer.themed();
    }

    async save() {
        const picture = await this.viewer.png();
        if (!picture) return;
        const address = URL.createObjectURL(picture);
        const name = this.title.textContent?.replace(/[^\w.-]+/g, "-") || "brdf";
        element("a", { href: address, download: `${name}.png` }).click();
        setTimeout(() => URL.revokeObjectURL(address), 1000);
        this.notice(`${name}.png is saved.`);
    }

    /**
     * Says something at the foot of the page.
     * @param {string} text
     * @param {boolean} wrong
     */
    notice(text, wrong = false) {
        clearTimeout(this.timer);
        this.message.textContent = text;
        this.message.classList.toggle("wrong", wrong);
        this.message.classList.add("shown");
        const hide = () => this.message.classList.remove("shown");
        this.timer = /** @type {any} */ (setTimeout(hide, wrong ? 2 * MESSAGE_TIME : MESSAGE_TIME));
    }

    /** @param {string} key pressed on the picture @returns {boolean} whether it means something */
    key(key) {
        const { viewer } = this;
        const next = (/** @type {{name: string}[]} */ entries, /** @type {string} */ name) =>
            entries[(entries.findIndex((entry) => entry.name === name) + 1) % entries.length].name;
        const comparison = COMPARISONS[Number(key) - 1];
        if (comparison) viewer.set({ compare: comparison });
        else if (key === "?") this.help.showModal();
        else if (key === "p") this.toggle();
        else if (key === "l") this.toggleLight();
        else if (key === "o") this.drop.choose();
        else if (key === "s") this.save();
        else if (key === "d") this.switchTheme();
        else if (key === "g") viewer.set({ mesh: next(viewer.payload.meshes, viewer.state.mesh) });
        else if (key === "[") viewer.set({ exposure: viewer.state.exposure - 0.25 });
        else if (key === "]") viewer.set({ exposure: viewer.state.exposure + 0.25 });
        else return false;
        return true;
    }
}

/** @param {number | undefined} bytes */
export function size(bytes) {
    if (!bytes) return "";
    const [factor, unit] = bytes < 1e3 ? [1, "bytes"] : bytes < 1e6 ? [1024, "KB"] : [1024 ** 2, "MB"];
    const number = bytes / factor;
    return `${number < 10 && factor > 1 ? number.toFixed(1) : Math.round(number)} ${unit}`;
}
