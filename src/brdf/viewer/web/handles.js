// Lights as handles on the picture: each stands where a ball around the shape would mirror it.

import { projected } from "./camera.js";
import { element } from "./element.js";
import { hexadecimal } from "./controls.js";
import { angles, direction, dot, plus, unit } from "./vector.js";

/**
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {import("./vector.js").Vector} Vector
 * @typedef {import("./state.js").Light} Light
 * @typedef {{middle: Vector, radius: number}} Ball
 * @typedef {{camera: Camera, ball: Ball, size: {width: number, height: number}, x: number}} Seen the camera of a pane
 *     that begins at `x`
 */

/** @param {import("./mesh.js").Mesh} mesh @returns {Ball} about as large as the shape */
export function ballOf({ least, greatest }) {
    const half = least.map((low, k) => (greatest[k] - low) / 2).sort((a, b) => a - b);
    const middle = /** @type {Vector} */ (least.map((low, k) => (greatest[k] + low) / 2));
    return { middle, radius: half[1] || half[2] || 1 };
}

/**
 * Where on the ball a place of the pane is, and the direction to a light whose mirror image is there; beside the ball,
 * at its rim.
 * @param {Seen} seen
 * @param {[number, number]} place
 * @returns {{at: Vector, toward: Vector}}
 */
export function mirrored({ camera, ball, size }, place) {
    const half = Math.tan((camera.fov * Math.PI) / 360);
    const x = ((place[0] - size.width / 2) / (size.height / 2)) * half;
    const y = ((size.height / 2 - place[1]) / (size.height / 2)) * half;
    const ray = unit([0, 1, 2].map((k) => x * camera.frame[0][k] + y * camera.frame[1][k] - camera.frame[2][k]));
    const from = plus(camera.position, ball.middle, -1);
    const nearest = -dot(from, ray);
    const closest = plus(from, ray, nearest);
    const inside = ball.radius ** 2 - dot(closest, closest);
    const normal = unit(inside > 0 ? plus(closest, ray, -Math.sqrt(inside)) : closest);
    const view = unit(plus(from, normal, -ball.radius));
    const toward = unit(plus(normal.map((n) => 2 * dot(normal, view) * n), view, -1));
    return { at: plus(ball.middle, normal, ball.radius), toward };
}

/**
 * Where on the pane the ball mirrors a light.
 * @param {Seen} seen
 * @param {Light} light
 */
function mirrorPlace({ camera, ball, size }, light) {
    const lamp = towardLight(light, ball.middle);
    const way = plus(unit(plus(camera.position, ball.middle, -1)), lamp, -1);  // to the eye
    let at = ball.middle;
    let share = 0.5;  // of the way, halved: a fixed point of the mirror's law would not converge for near lights
    for (let step = 0.25; step > 1e-7; step /= 2) {
        const normal = unit(plus(lamp, way, share));
        at = plus(ball.middle, normal, ball.radius);
        const view = unit(plus(camera.position, at, -1));
        share += dot(normal, towardLight(light, at)) > dot(normal, view) ? step : -step;
    }
    return projected(camera, at, size);
}

/** @param {Light} light @param {Vector} from @returns {Vector} the unit vector from there to the light */
function towardLight(light, from) {
    if (light.kind === "point") return unit(plus(/** @type {number[]} */ (light.position), from, -1));
    return direction(light.theta ?? 0, light.phi ?? 0);
}

/**
 * The light, moved into a direction as seen from a point; a point light keeps its distance from the ball.
 * @param {Light} light
 * @param {{at: Vector, toward: Vector}} place
 * @param {Ball} ball
 * @returns {Light}
 */
export function turnedTo(light, { at, toward }, ball) {
    if (light.kind === "point") {
        const old = plus(/** @type {number[]} */ (light.position), ball.middle, -1);
        const from = plus(at, ball.middle, -1);
        const across = dot(from, toward);
        const reach = Math.sqrt(Math.max(0, across * across + dot(old, old) - dot(from, from))) - across;
        return { ...light, position: plus(at, toward, Math.max(reach, 0.01 * ball.radius)) };
    }
    const [theta, phi] = angles(toward);
    return { ...light, theta, phi };
}

/**
 * The light, moved by angles; what the arrow keys do.
 * @param {Light} light
 * @param {number} across degrees
 * @param {number} down degrees
 * @param {Ball} ball
 */
export function turnedBy(light, across, down, ball) {
    const [theta, phi] = angles(towardLight(light, ball.middle));
    const toward = direction(Math.min(179, Math.max(1, theta + down)), phi + across);
    return turnedTo(light, { at: ball.middle, toward }, ball);
}

/** The handles over the canvas. */
export class Handles {
    /**
     * @param {{move: (index: number, place: [number, number]) => void,
     *     nudge: (index: number, across: number, down: number) => void, pick: (index: number) => void}} act
     */
    constructor(act) {
        this.act = act;
        this.element = element("div", { class: "handles" });
    }

    /**
     * @param {Light[]} lights
     * @param {Seen} seen
     * @param {number} selected
     */
    refresh(lights, seen, selected) {
        const made = this.element.children;
        while (made.length > lights.length) this.element.lastChild?.remove();
        while (made.length < lights.length) this.element.append(this.made(made.length));
        lights.forEach((light, i) => {
            const [x, y] = mirrorPlace(seen, light);
            const handle = /** @type {HTMLElement} */ (made[i]);
            const brightest = Math.max(...light.power) || 1;
            handle.style.transform = `translate(${(x + seen.x).toFixed(1)}px, ${y.toFixed(1)}px)`;
            handle.style.setProperty("--light", hexadecimal(light.power.map((p) => p / brightest)));
            handle.classList.toggle("selected", i === selected && lights.length > 1);
        });
    }

    /** @param {number} index */
    made(index) {
        const { act } = this;
        const name = `Light ${index + 1}`;
        const handle = element("button", {
            type: "button", class: "handle", "aria-label": `${name}: drag, or turn it with the arrow keys`, title: name,
            onfocus: () => act.pick(index),
            onkeydown: (/** @type {KeyboardEvent} */ event) => {
                const arrows = { ArrowLeft: [-5, 0], ArrowRight: [5, 0], ArrowUp: [0, -5], ArrowDown: [0, 5] };
                const arrow = arrows[/** @type {keyof typeof arrows} */ (event.key)];
                if (!arrow) return;
                event.preventDefault();
                act.nudge(index, arrow[0], arrow[1]);
            },
            onpointerdown: (/** @type {PointerEvent} */ event) => {
                handle.setPointerCapture(event.pointerId);
                act.pick(index);
            },
            onpointermove: (/** @type {PointerEvent} */ event) => {
                if (!handle.hasPointerCapture(event.pointerId)) return;
                const box = this.element.getBoundingClientRect();
                act.move(index, [event.clientX - box.left, event.clientY - box.top]);
            },
        });
        return handle;
    }
}
