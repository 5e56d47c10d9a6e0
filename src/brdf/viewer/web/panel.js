// The panel: what is shown, on what, in which light, and how it is compared.

import { changing, choice, section, select, slider, toggle } from "./controls.js";
import { element, iconButton } from "./element.js";
import { lightControls } from "./panel_lights.js";
import { parameterControls } from "./panel_parameters.js";
import { NAMES } from "./slots.js";
import { COMPARISONS, MOST_LIGHTS, RANGES, TONES } from "./state.js";

/**
 * @typedef {import("./viewer.js").Viewer} Viewer
 * @typedef {import("./controls.js").Control} Control
 */

/** @type {Record<string, string>} */
const COMPARED = { first: "A", second: "B", split: "Split", side: "Side", difference: "A − B" };

/** @param {string} word */
const capital = (word) => word[0].toUpperCase() + word.slice(1);

/** What is chosen by its name. @param {{name: string}[]} entries @returns {[string, string][]} */
function named(entries) {
    return entries.map(({ name }) => [name, capital(name)]);
}

/**
 * @param {Viewer} viewer
 * @returns {Control}
 */
export function panel(viewer) {
    const sections = [
        materialSection(viewer), compareSection(viewer), shapeSection(viewer), lightSection(viewer),
        pictureSection(viewer), ...(viewer.drawer.views.length ? [viewsSection(viewer)] : []),
    ];
    const made = element("div", { class: "sections" }, ...sections.map((one) => one.element));
    return { element: made, refresh: () => sections.forEach((one) => one.refresh()) };
}

/** @param {Viewer} viewer @param {keyof typeof RANGES & string} key @param {any} given */
function stateSlider(viewer, key, given) {
    const read = () => /** @type {any} */ (viewer.state)[key];
    return slider({ ...given, read, write: (value) => viewer.set({ [key]: value }) });
}

/** @param {Viewer} viewer @returns {Control} */
function materialSection(viewer) {
    let edited = 0;  // which of A and B the sliders belong to
    const slot = () => (viewer.state.compare === "first" ? 0 : viewer.state.compare === "second" ? 1 : edited);
    const material = () => viewer.slots.at(slot());
    const which = choice({
        label: "Settings of", hidden: true,
        options: () => NAMES.map((name, i) => [name, `${name}  ${viewer.slots.at(i).name}`]),
        read: () => NAMES[slot()],
        write: (name) => {
            edited = NAMES.indexOf(name);
            viewer.refresh(["view"]);
        },
    });
    const chosen = select({
        label: "Material",
        options: () => viewer.slots.sources.map((source, i) => [String(i), source.shader.name]),
        read: () => String(viewer.state.materials[slot()]),
        write: (index) => viewer.set({
            materials: viewer.state.materials.with(slot(), Number(index)),
            parameters: viewer.state.parameters.with(slot(), {}),
        }),
    });
    const note = element("p", { class: "note" });
    const parameters = changing(
        () => `${slot()} ${viewer.state.materials[slot()]}`,
        () => parameterControls(viewer, slot()),
    );
    const reset = iconButton("reset", "Reset the parameters", () => {
        viewer.set({ parameters: viewer.state.parameters.with(slot(), {}) });
        viewer.canvas.focus();  // the button is gone
    }, { class: "icon action" });
    const made = section("Material", [which, chosen, parameters, plain(note)], { action: reset });
    const refresh = () => {
        which.element.hidden = !["split", "side", "difference"].includes(viewer.state.compare);
        chosen.element.hidden = viewer.slots.sources.length < 2;
        reset.hidden = !material().changed;
        const { note: said, shader } = material().source;
        note.textContent = [said, shader.source].filter(Boolean).join(" ");
        made.refresh();
    };
    return { element: made.element, refresh };
}

/** @param {HTMLElement} made @returns {Control} */
function plain(made) {
    return { element: made, refresh: () => {} };
}

/** @param {Viewer} viewer @returns {Control} */
function compareSection(viewer) {
    const how = choice({
        label: "Comparison", hidden: true,
        options: () => COMPARISONS.map((key) => [key, COMPARED[key]]),
        read: () => viewer.state.compare,
        write: (compare) => viewer.set({ compare }),
    });
    const gain = stateSlider(viewer, "gain", { label: "Times", scale: { low: 1, high: 64, log: true } });
    const number = element("p", { class: "measure", role: "status" });
    const made = section("Compare", [how, gain, plain(number)], { open: viewer.slots.sources.length > 1 });
    const refresh = () => {
        gain.element.hidden = viewer.state.compare !== "difference";
        const { psnr } = viewer.measure;
        number.textContent = psnr === Infinity ? "A and B agree" : `PSNR ${psnr?.toFixed(1)} dB`;
        number.hidden = psnr === null;
        made.refresh();
    };
    return { element: made.element, refresh };
}

/** @param {Viewer} viewer @returns {Control} */
function shapeSection(viewer) {
    const given = {
        label: "Shape", options: () => named(viewer.payload.meshes), read: () => viewer.state.mesh,
        write: (/** @type {string} */ mesh) => viewer.set({ mesh }),
    };
    return section("Shape", [viewer.payload.meshes.length > 4 ? select(given) : choice({ ...given, hidden: true })]);
}

/** @param {Viewer} viewer @returns {Control} */
function lightSection(viewer) {
    const around = select({
        label: "Surroundings",
        options: () => [["", "None"], ...named(viewer.payload.environments)],
        read: () => viewer.state.environment ?? "",
        write: (name) => viewer.set({ environment: name || null }),
    });
    const turn = slider({
        label: "Turned", scale: { low: 0, high: 360, unit: "°" },
        read: () => ((viewer.state.turn % 360) + 360) % 360,
        write: (value) => viewer.set({ turn: value }),
    });
    const strength = stateSlider(viewer, "strength", { label: "Strength", scale: { low: 0.1, high: 10, log: true } });
    const lights = changing(
        () => String(viewer.state.lights.length),
        () => viewer.state.lights.map((_, i) => lightControls(viewer, i)),
    );
    const add = element("button", {
        type: "button", class: "add",
        onclick: () => {
            const count = viewer.state.lights.length;
            const light = { kind: "directional", theta: 45, phi: 30 + 75 * count, power: [1, 1, 1] };
            viewer.set({ lights: [...viewer.state.lights, light] });
            viewer.select(count);
        },
    }, "Add a light");
    const shadows = toggle({
        label: "Shadows", read: () => viewer.state.shadows, write: (on) => viewer.set({ shadows: on }),
    });
    const made = section("Light", [around, turn, strength, lights, plain(add), shadows]);
    const refresh = () => {
        turn.element.hidden = strength.element.hidden = !viewer.state.environment;
        add.disabled = viewer.state.lights.length >= MOST_LIGHTS;
        made.refresh();
    };
    return { element: made.element, refresh };
}

/** @param {Viewer} viewer @returns {Control} */
function pictureSection(viewer) {
    const exposure = stateSlider(viewer, "exposure", { label: "Exposure", scale: { low: -4, high: 4, unit: " EV" } });
    const tone = choice({
        label: "Tone", hidden: true, options: () => TONES.map((name) => [name, capital(name)]),
        read: () => viewer.state.tone, write: (value) => viewer.set({ tone: value }),
    });
    const backdrop = choice({
        label: "Backdrop", options: () => [["gradient", "Grey"], ["environment", "Around"], ["plain", "Plain"]],
        read: () => viewer.state.background, write: (value) => viewer.set({ background: value }),
    });
    return section("Picture", [exposure, tone, backdrop], { open: false });
}

/** @param {Viewer} viewer @returns {Control} */
function viewsSection(viewer) {
    const buttons = viewer.drawer.views.map((view) => element("button", {
        type: "button", value: view.id,
        onclick: () => viewer.set({ view: viewer.state.view === view.id ? null : view.id }),
    }, view.title));
    const row = element("div", { class: "views" }, ...buttons);
    const refresh = () => {
        for (const button of buttons) button.setAttribute("aria-pressed", String(button.value === viewer.state.view));
    };
    return section("Plots", [{ element: row, refresh }]);
}
