// The viewer: holds the state, draws what it says, and lets hands, keys, address and notebook change it.

import { decodedEnvironment } from "./environment.js";
import { divider } from "./divider.js";
import { Drawer } from "./drawer.js";
import { element } from "./element.js";
import { Evaluator } from "./evaluate.js";
import { ballOf, Handles, mirrored, turnedBy, turnedTo } from "./handles.js";
import { frame } from "./frame.js";
import { listen } from "./input.js";
import { Framer, panes } from "./layout.js";
import { Material } from "./material.js";
import { Measure } from "./measure.js";
import { decodedMesh } from "./mesh.js";
import { decode } from "./payload.js";
import { Progress } from "./progress.js";
import { Renderer } from "./renderer.js";
import { NAMES, Slots } from "./slots.js";
import { clamped, decodedHash, encoded, initialState, merged, RANGES, TONES } from "./state.js";

/**
 * @typedef {import("./state.js").State} State
 * @typedef {import("./renderer.js").Shot} Shot
 * @typedef {{picture?: HTMLElement, embedded?: boolean}} Options `picture`: what stands in the root until the first
 *     frame is drawn; `embedded`: within another page, whose address is not ours
 */

const LARGEST_PICTURE = 2.2e6;  // pixels
const DEGREES = 0.4;  // a pixel that the hand moves
let mounted = 0;
const PLAIN = { dark: 0.012, light: 0.8 };

/**
 * Shows what a payload holds in an element. Throws an Error of one sentence where that cannot be.
 * @param {HTMLElement} root
 * @param {ArrayBuffer | ArrayBufferView} buffer
 * @param {Options} options
 */
export function mount(root, buffer, options = {}) {
    return new Viewer(root, decode(buffer), options);
}

export class Viewer {
    /**
     * @param {HTMLElement} root
     * @param {import("./payload.js").Payload} payload
     * @param {Options} options
     */
    constructor(root, payload, options) {
        const canvas = element("canvas", { role: "img", tabindex: 0, "aria-describedby": `brdf-keys-${++mounted}` });
        const given = { antialias: false, alpha: false, depth: false, powerPreference: "high-performance" };
        const gl = canvas.getContext("webgl2", /** @type {WebGLContextAttributes} */ (given));
        if (!gl) throw new Error("This browser has no WebGL2.");
        this.root = root;
        this.options = options;
        this.payload = payload;
        this.canvas = canvas;
        this.gl = gl;
        this.slots = new Slots(gl, payload);
        this.renderer = new Renderer(gl, payload.stages);
        this.evaluator = new Evaluator(gl, payload.stages);
        this.measure = new Measure(this.evaluator, this.slots, () => this.frame.refresh(), (e) => this.failed(e));
        this.framer = new Framer();
        this.ending = new AbortController();
        /** @type {Map<string, any>} */
        this.decoded = new Map();
        /** @type {((state: State) => void)[]} */
        this.listeners = [];
        this.selected = 0;
        this.lighting = false;
        /** @type {import("./layout.js").Pane[]} */
        this.panes = [];
        this.home = initialState(payload);
        this.state = options.embedded ? this.home : merged(this.home, decodedHash(location.hash), this.choices);
        this.slots.follow(this.state);
        this.divider = divider((share) => this.set({ divider: share }));
        this.handles = new Handles({
            move: (index, place) => this.moveLight(index, place),
            nudge: (index, across, down) => this.nudgeLight(across, down, index),
            pick: (index) => this.select(index),
        });
        this.drawer = new Drawer(this);
        this.frame = frame(this);
        root.classList.add("brdf");
        root.dataset.embedded = String(Boolean(options.embedded));
        root.append(this.frame.element);
        this.progress = new Progress(this.renderer, {
            shots: () => this.shots(),
            present: (pictures, shots) => this.present(pictures, shots),
            failed: (error) => this.failed(error),
            stateful: (state) => void (root.dataset.state = state),
        });
        this.listen();
        this.refresh();
    }

    get choices() {
        return { ...this.payload, materials: /** @type {any[]} */ (this.slots.sources) };
    }

    listen() {
        const { signal } = this.ending;
        const { canvas, root } = this;
        listen(canvas, {
            orbit: (x, y) => this.orbit(x, y),
            pan: (x, y) => {
                const scale = (2 * Math.tan(Math.PI / 12)) / canvas.clientHeight / this.state.zoom;
                this.set({ pan: [this.state.pan[0] + x * scale, this.state.pan[1] - y * scale] });
            },
            zoom: (factor) => this.set({ zoom: this.state.zoom * factor }),
            light: (place, x) => {
                if (this.state.lights.length) this.moveLight(this.selected, place);
                else this.set({ turn: this.state.turn + x * DEGREES });
            },
            nudgeLight: (x, y) => this.nudgeLight(x * DEGREES, y * DEGREES),
            lighting: () => this.lighting,
            home: () => this.set({ theta: this.home.theta, phi: this.home.phi, zoom: this.home.zoom, pan: [0, 0] }),
            key: (key) => this.frame.key(key),
            embedded: Boolean(this.options.embedded),
        }, signal);
        canvas.addEventListener("webglcontextlost", (event) => event.preventDefault(), { signal });
        canvas.addEventListener("webglcontextrestored", () => this.restore(), { signal });
        if (!this.options.embedded) {
            const read = () => this.set(merged(this.home, decodedHash(location.hash), this.choices));
            window.addEventListener("hashchange", read, { signal });
        }
        const observer = new ResizeObserver(() => this.resize());
        for (const one of [root, this.frame.side, this.drawer.element]) observer.observe(one);
        const dark = window.matchMedia("(prefers-color-scheme: dark)");
        dark.addEventListener("change", () => this.themed(), { signal });
        signal.addEventListener("abort", () => observer.disconnect());
    }

    // ---- the state

    /** @param {Record<string, any>} patch from outside: what is not valid of it is passed over */
    setState(patch) {
        this.set(patch);
    }

    /** @param {Record<string, any>} patch */
    set(patch) {
        const before = this.state;
        this.state = merged(before, patch, this.choices);
        const changed = Object.keys(patch).some((key) => {
            const [was, is] = [before, this.state].map((state) => /** @type {any} */ (state)[key]);
            return JSON.stringify(was) !== JSON.stringify(is);
        });
        if (!changed) return;
        if (this.state.materials !== before.materials || this.state.parameters !== before.parameters) {
            this.slots.follow(this.state);
        }
        this.selected = clamped(this.selected, [0, Math.max(0, this.state.lights.length - 1)]);
        this.refresh(Object.keys(patch));
        for (const tell of this.listeners) tell(this.state);
    }

    /** @param {(state: State) => void} tell is called with every new state; gives what ends that */
    onChange(tell) {
        this.listeners.push(tell);
        return () => void (this.listeners = this.listeners.filter((other) => other !== tell));
    }

    /** Makes everything show the state. @param {string[]} keys what changed of it; nothing: all */
    refresh(keys = []) {
        this.measure.follow(this.state.compare !== "first");
        this.frame.refresh();
        this.drawer.refresh();
        this.arrange();
        const shownOnly = ["divider", "gain", "exposure", "tone", "background", "view"];
        if (keys.length && keys.every((key) => shownOnly.includes(key))) this.progress.shownChanged();
        else this.progress.changed();
        this.remember();
    }

    /** Writes the state into the address, not more often than browsers allow. */
    remember() {
        if (this.options.embedded || this.remembering) return;
        this.remembering = setTimeout(() => {
            this.remembering = undefined;
            const hash = encoded(this.state, this.home);
            history.replaceState(null, "", `#${hash}`);
        }, 250);
    }

    /** @type {ReturnType<typeof setTimeout> | undefined} */
    remembering = undefined;

    // ---- hands

    /** @param {number} x @param {number} y */
    orbit(x, y) {
        const { theta, phi } = this.state;
        this.set({ theta: clamped(theta - y * DEGREES, RANGES.theta), phi: phi - x * DEGREES });
    }

    /** @param {number} index */
    select(index) {
        this.selected = index;
        this.arrange();
    }

    /** @param {number} index @param {[number, number]} place on the canvas */
    moveLight(index, place) {
        const pane = this.panes.findLast((p) => place[0] >= p.place.x) ?? this.panes[0];
        const seen = this.seen(pane);
        const mirror = mirrored(seen, [place[0] - pane.place.x, place[1]]);
        this.set({ lights: this.state.lights.with(index, turnedTo(this.state.lights[index], mirror, seen.ball)) });
    }

    /** @param {number} across degrees @param {number} down degrees @param {number} index */
    nudgeLight(across, down, index = this.selected) {
        const { lights, turn } = this.state;
        const ball = ballOf(this.mesh);
        if (!lights.length) this.set({ turn: turn + across });
        else this.set({ lights: lights.with(index, turnedBy(lights[index], across, down, ball)) });
    }

    // ---- the picture

    get mesh() {
        return /** @type {import("./mesh.js").Mesh} */ (this.entry("meshes", this.state.mesh, decodedMesh));
    }

    get environment() {
        return /** @type {import("./environment.js").Environment | null} */ (
            this.entry("environments", this.state.environment, decodedEnvironment)
        );
    }

    /** @param {"meshes" | "environments"} kind @param {string | null} name @param {any} read */
    entry(kind, name, read) {
        const entry = this.payload[kind].find((/** @type {any} */ one) => one.name === name);
        if (!entry) return null;
        const key = `${kind} ${name}`;
        if (!this.decoded.has(key)) this.decoded.set(key, read(entry, this.payload));
        return this.decoded.get(key);
    }

    /** Pixels of the canvas for one of the page. */
    get ratio() {
        const { clientWidth, clientHeight } = this.canvas;
        const most = Math.sqrt(LARGEST_PICTURE / Math.max(1, clientWidth * clientHeight));
        return Math.min(window.devicePixelRatio || 1, 2, most);
    }

    resize() {
        const { canvas, ratio } = this;
        const sides = [canvas.clientWidth, canvas.clientHeight];
        const [width, height] = sides.map((side) => Math.max(1, Math.round(side * ratio)));
        if (canvas.width !== width || canvas.height !== height) {
            Object.assign(canvas, { width, height });
            this.progress.changed();
        }
        this.arrange();
    }

    /** Places panes, handles and divider. */
    arrange() {
        const size = { width: this.canvas.clientWidth || 1, height: this.canvas.clientHeight || 1 };
        const free = this.frame.free(size);
        const before = JSON.stringify(this.panes);
        this.panes = panes(this.state.compare, size, free);
        if (JSON.stringify(this.panes) !== before) this.progress.changed();  // a panel covers another part of it
        this.handles.refresh(this.state.lights, this.seen(this.panes[0]), this.selected);
        const [low, high] = [free.x / size.width, (free.x + free.width) / size.width];
        this.divider.refresh(this.state.compare === "split", this.state.divider, low, high);
        this.frame.arrange(this.panes);
    }

    /** @param {import("./layout.js").Pane} pane */
    seen(pane) {
        const size = { width: pane.place.width, height: pane.place.height };
        return { camera: this.cameraOf(pane), ball: ballOf(this.mesh), size, x: pane.place.x };
    }

    /** @param {import("./layout.js").Pane} pane */
    cameraOf(pane) {
        return this.framer.camera(this.mesh, pane, this.state);
    }

    /** The camera of the first picture, as brdf.render.Camera takes it. */
    camera() {
        const { position, target, fov } = this.cameraOf(this.panes[0]);
        return { position, target, fov };
    }

    /** @param {import("./layout.js").Pane} pane in pixels of the canvas, from its lower left corner */
    placeOf({ place }) {
        const { canvas, ratio } = this;
        const x = Math.round(place.x * ratio);
        const end = Math.min(canvas.width, Math.round((place.x + place.width) * ratio));
        return { x, y: 0, width: end - x, height: canvas.height };
    }

    /** @returns {Shot[]} */
    shots() {
        const { lights, turn, strength, shadows } = this.state;
        const scene = { mesh: this.mesh, lights, environment: this.environment, turn, strength, shadows };
        return this.panes.flatMap((pane) => pane.slots.map((slot) => {
            const { width, height } = this.placeOf(pane);
            return { scene, material: this.slots.at(slot), camera: this.cameraOf(pane), width, height };
        }));
    }

    /** @param {import("./renderer.js").Picture[]} pictures @param {Shot[]} shots */
    present(pictures, shots) {
        const { state } = this;
        let next = 0;
        for (const pane of this.panes) {
            const first = next;
            next += pane.slots.length;
            this.renderer.present(this.placeOf(pane), pictures[first], pictures[next - 1], shots[first], {
                shown: pane.shown, divider: state.divider, gain: state.gain, exposure: state.exposure,
                tone: TONES.indexOf(state.tone), background: /** @type {any} */ (state.background),
                plain: Array(3).fill(PLAIN[this.theme()]),
            });
        }
        this.options.picture?.remove();
    }

    /** Says what went wrong, and goes on. @param {unknown} error */
    failed(error) {
        this.frame.notice(error instanceof Error ? error.message : String(error), true);
    }

    restore() {
        this.slots.forget();
        this.renderer.forget();
        this.evaluator.forget();
        this.progress.restart();
        this.drawer.rebuild();
        this.refresh();
    }

    // ---- the rest

    /** @returns {"dark" | "light"} */
    theme() {
        const chosen = this.root.dataset.theme;
        if (chosen === "dark" || chosen === "light") return chosen;
        return window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
    }

    themed() {
        this.frame.refresh();
        this.drawer.refresh();
        this.progress.shownChanged();
    }

    /** A and, where it is compared with, B. */
    materials() {
        const several = this.state.compare !== "first";
        return [this.slots.at(0), ...(several ? [this.slots.at(1)] : [])];
    }

    /**
     * Shows another material as A, or as B where two are compared, once it is known that it can be drawn: else throws.
     * @param {import("./material.js").Source} source
     * @param {number} [wanted] 0 for A, 1 for B
     */
    async add(source, wanted) {
        const material = new Material(this.gl, source);
        const stage = this.renderer.stageOf(this.shots()[0].scene);
        while (!material.program(stage).ready) await new Promise(requestAnimationFrame);
        material.use(stage);
        const { materials, parameters, compare } = this.state;
        const slot = wanted ?? Number(compare !== "first");
        const index = this.slots.take(slot, material);
        this.set({
            materials: materials.with(slot, index), parameters: parameters.with(slot, {}),
            ...(slot && compare === "first" && { compare: "split" }),
        });
        this.frame.notice(`${source.shader.name} is shown as ${NAMES[slot]}.`);
    }

    /** The picture as it is seen, as a PNG. @returns {Promise<Blob | null>} */
    png() {
        this.progress.again();
        return new Promise((done) => this.canvas.toBlob(done, "image/png"));
    }

    destroy() {
        this.ending.abort();
        clearTimeout(this.remembering);
        this.progress.dispose();
        this.drawer.close();
        this.measure.dispose();
        this.evaluator.dispose();
        this.renderer.dispose();
        this.slots.dispose();
        this.frame.element.remove();
        this.gl.getExtension("WEBGL_lose_context")?.loseContext();
    }
}
