// The drawer that shows the field's plots: lobes, slices, albedo, the slice of the image.

import { element, iconButton } from "./element.js";
import { VIEWS } from "./views/all.js";

/**
 * @typedef {{update: () => void, destroy: () => void}} Drawn
 * @typedef {{id: string, title: string, create: (container: HTMLElement, context: any) => Drawn}} View
 */

export class Drawer {
    /** @param {import("./viewer.js").Viewer} viewer */
    constructor(viewer) {
        this.viewer = viewer;
        /** @type {View[]} */
        this.views = VIEWS;
        this.title = element("h2", {});
        this.body = element("div", { class: "view" });
        const close = iconButton("close", "Close the plot", () => viewer.set({ view: null }));
        const head = element("header", {}, this.title, close);
        this.element = element("section", { class: "drawer", "aria-label": "Plot", hidden: true }, head, this.body);
        /** @type {Drawn | null} */
        this.drawn = null;
        this.shown = "";
        this.request = 0;
    }

    get context() {
        const { viewer } = this;
        return {
            evaluator: viewer.evaluator,
            materials: () => viewer.materials(),
            payload: viewer.payload,
            get state() {
                return viewer.state;
            },
            theme: () => viewer.theme(),
        };
    }

    /** Follows the state; plots are drawn once a frame at most. */
    refresh() {
        const wanted = this.views.find((view) => view.id === this.viewer.state.view);
        if ((wanted?.id ?? "") !== this.shown) {
            this.close();
            this.element.hidden = !wanted;
            if (!wanted) return;
            this.shown = wanted.id;
            this.title.textContent = wanted.title;
            this.drawn = wanted.create(this.body, this.context);
            this.draw();
            return;
        }
        if (!this.drawn || this.request) return;
        this.request = requestAnimationFrame(() => this.draw());
    }

    draw() {
        this.request = 0;
        if (this.viewer.gl.isContextLost()) return;
        try {
            this.drawn?.update();
        } catch (error) {
            this.viewer.failed(error);
        }
    }

    /** Makes the plot anew, after a lost context. */
    rebuild() {
        this.close();
        this.refresh();
    }

    close() {
        cancelAnimationFrame(this.request);
        this.request = 0;
        this.drawn?.destroy();
        this.drawn = null;
        this.shown = "";
        this.body.replaceChildren();
    }
}
