// One light of the panel: its kind, colour and power.

import { colour, select, slider } from "./controls.js";
import { element, iconButton } from "./element.js";
import { ballOf } from "./handles.js";
import { angles, direction, plus, unit } from "./vector.js";

/**
 * @typedef {import("./viewer.js").Viewer} Viewer
 * @typedef {import("./state.js").Light} Light
 */

const LEAST_POWER = 0.01;
const MOST_POWER = 100;
const DISTANCE = 3;  // of a light that becomes a point, in radii of the shape

/**
 * @param {Viewer} viewer
 * @param {number} index
 * @returns {import("./controls.js").Control}
 */
export function lightControls(viewer, index) {
    const light = () => /** @type {Light} */ (viewer.state.lights[index]);
    const change = (/** @type {Light} */ made) => {
        viewer.set({ lights: viewer.state.lights.with(index, made) });
        viewer.select(index);
    };
    const most = () => Math.max(...light().power);
    const number = index + 1;
    const name = `Light ${number}`;
    const well = colour({
        label: `Colour of light ${number}`, bare: true,
        read: () => light().power.map((p) => p / (most() || 1)),
        write: (rgb) => {
            const peak = Math.max(...rgb) || 1;
            change({ ...light(), power: rgb.map((c) => (c / peak) * most()) });
        },
    });
    const kind = select({
        label: `Kind of light ${number}`,
        options: () => [["directional", "Parallel"], ["point", "Point"]],
        read: () => light().kind,
        write: (value) => change(converted(light(), value, viewer)),
    });
    const power = slider({
        label: "Power", scale: { low: LEAST_POWER, high: MOST_POWER, log: true },
        read: most,
        write: (value) => {
            const scale = most() > 0 ? value / most() : 0;
            change({ ...light(), power: scale ? light().power.map((p) => p * scale) : [value, value, value] });
        },
    });
    const remove = iconButton("close", `Remove light ${number}`, () => {
        viewer.set({ lights: viewer.state.lights.filter((_, i) => i !== index) });
        viewer.canvas.focus();  // the button is gone
    });
    const list = /** @type {HTMLElement} */ (kind.element.querySelector("select"));
    const made = element("div", { class: "light", role: "group", "aria-label": name },
        element("div", { class: "light-head" }, well.element, element("span", { class: "label" }, name), list, remove),
        power.element);
    const refresh = () => {
        if (!light()) return;
        for (const control of [well, kind, power]) control.refresh();
        made.classList.toggle("selected", viewer.selected === index && viewer.state.lights.length > 1);
    };
    return { element: made, refresh };
}

/**
 * The light as another kind, from the same side and as bright on the shape.
 * @param {Light} light
 * @param {string} kind
 * @param {Viewer} viewer
 * @returns {Light}
 */
function converted(light, kind, viewer) {
    if (light.kind === kind) return light;
    const ball = ballOf(viewer.mesh);
    if (kind === "point") {
        const distance = DISTANCE * ball.radius;
        const position = plus(ball.middle, direction(light.theta ?? 0, light.phi ?? 0), distance);
        return { kind, position, power: light.power.map((p) => p * distance ** 2) };
    }
    const offset = plus(/** @type {number[]} */ (light.position), ball.middle, -1);
    const [theta, phi] = angles(unit(offset));
    return { kind, theta, phi, power: light.power.map((p) => p / (Math.hypot(...offset) ** 2 || 1)) };
}
