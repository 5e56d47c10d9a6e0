// The viewer in a notebook: what Python sets is shown, what is done here is told.

import { mount } from "./viewer.js";

/**
 * @typedef {{get: (name: string) => any, set: (name: string, value: any) => void, save_changes: () => void,
 *     on: (event: string, then: () => void) => void, off: (event: string, then: () => void) => void}} Model
 */

/** @param {{model: Model, el: HTMLElement}} given */
function render({ model, el }) {
    const root = document.createElement("div");
    el.append(root);
    const resize = () => (root.style.height = `${model.get("height")}px`);
    resize();
    /** @type {ReturnType<typeof mount> | null} */
    let viewer = null;
    let told = "";
    const tell = () => {
        if (!viewer) return;
        told = JSON.stringify(viewer.state);
        model.set("state", JSON.parse(told));
        model.save_changes();
    };
    const hear = () => {
        const state = model.get("state");
        const heard = JSON.stringify(state);
        if (!viewer || heard === told || heard === "{}") return;
        viewer.setState(state);
        tell();  // what was not valid of it is not there
    };
    const show = () => {
        viewer?.destroy();
        root.replaceChildren();
        try {
            viewer = mount(root, model.get("payload"), { embedded: true });
            told = "";  // by the one before
            hear();
            viewer.onChange(tell);
        } catch (error) {
            viewer = null;
            root.textContent = error instanceof Error ? error.message : String(error);
        }
    };
    show();
    model.on("change:payload", show);
    model.on("change:state", hear);
    model.on("change:height", resize);
    return () => {
        model.off("change:payload", show);
        model.off("change:state", hear);
        model.off("change:height", resize);
        viewer?.destroy();
    };
}

export default { render };
