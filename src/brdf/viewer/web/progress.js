// When what is drawn: a quick picture while things change, then pass after pass until nothing gets better.

import { projected } from "./camera.js";
import { Picture } from "./renderer.js";

/**
 * @typedef {import("./renderer.js").Shot} Shot
 * @typedef {{pictures: Picture[], shots: Shot[], passes: number, samples: number, shownFrom: number}} Phase pictures of
 *     the shots, how many passes they get, and after how many they are shown
 */

/** Milliseconds: of a frame while things move, and of rest before the refinement. */
const FRAME = 50;
const REST = 120;

/** Work is sent in pieces of so many milliseconds, so that the page stays responsive; slow cards get larger ones. */
const PIECE = { fast: 30, slow: 120 };

const RAYS_SIDE = 4;
const SUBSAMPLES = RAYS_SIDE * RAYS_SIDE;
const DIRECTIONS = 256;  // to the environment, of each kind, until a picture is done
const COARSE_PASSES = 8;
const SLOW = 0.4;  // effort below which a coarse picture is refined before a large fine one
const LARGE = 1e5;  // pixels
const VERY_SLOW = 0.12;  // and below which nothing casts shadows while things move
const LEAST_EFFORT = 0.04;
const MOST_EFFORT = 8;

/** Places in a pixel, as brdf.render.background.offsets, in an order that spreads from the first on. */
const PLACES = Array.from({ length: SUBSAMPLES }, (_, n) => {
    const k = (n * 7) % SUBSAMPLES;
    const [i, j] = [Math.floor(k / RAYS_SIDE), k % RAYS_SIDE];
    const [x, y] = [(i + (j + 0.5) / RAYS_SIDE) / RAYS_SIDE, (j + (i + 0.5) / RAYS_SIDE) / RAYS_SIDE];
    return /** @type {[number, number]} */ ([x, y]);
});

/** The only pass of a quick picture. */
const FIRST = { number: 0, place: /** @type {[number, number]} */ ([0.5, 0.5]) };

export class Progress {
    /** @type {Shot[]} */
    shots = [];
    /** The quick pictures, the coarse ones, and those of all pixels. @type {Picture[][]} */
    pictures = [[], [], []];
    /** What the screen shows. @type {Picture[]} */
    shown = [];
    /** What is still to be refined. @type {Phase[]} */
    phases = [];
    /** Work that the card has not finished. @type {{sync: WebGLSync, measure: (time: number) => void} | null} */
    pending = null;
    dirty = false;
    stale = false;
    since = 0;
    row = 0;
    turn = 0;  // which of the shots is being refined
    effort = 0.06;  // 1: every pixel while things move; below, fewer; above, more samples
    rows = 32;
    request = 0;
    stopped = false;

    /**
     * @param {import("./renderer.js").Renderer} renderer
     * @param {{shots: () => Shot[], present: (pictures: Picture[], shots: Shot[]) => void,
     *     failed: (error: unknown) => void, stateful: (state: string) => void}} host `shots` are drawn from scratch
     *     whenever something changed; `present` shows a picture of each
     */
    constructor(renderer, host) {
        this.renderer = renderer;
        this.gl = renderer.gl;
        this.host = host;
    }

    /** Forgets all pictures. */
    restart() {
        this.shots = [];
        this.pictures = [[], [], []];
        this.shown = [];
        this.phases = [];
        this.pending = null;
        this.changed();
    }

    /** Something that is seen changed. */
    changed() {
        this.dirty = true;
        this.since = performance.now();
        this.host.stateful("moving");
        this.wake();
    }

    /** Only how the pictures are shown changed. */
    shownChanged() {
        this.stale = true;
        this.wake();
    }

    wake() {
        if (!this.request && !this.stopped) this.request = requestAnimationFrame(() => this.frame());
    }

    frame() {
        this.request = 0;
        if (this.stopped || this.gl.isContextLost()) return;
        try {
            if (this.step()) this.wake();
        } catch (error) {
            this.host.failed(error);
        }
    }

    /** One frame's work; whether there is more to come. */
    step() {
        if (this.stale) this.again();
        this.stale = false;
        if (!this.idle()) return true;
        if (this.dirty) return this.preview();
        if (!this.phases.length) return false;
        if (performance.now() - this.since > REST) this.refine(this.phases[0]);
        return true;
    }

    /** Whether the card has done what it was given; no more is sent until then. */
    idle() {
        if (!this.pending) return true;
        const { sync, measure } = this.pending;
        if (this.gl.getSyncParameter(sync, this.gl.SYNC_STATUS) !== this.gl.SIGNALED) return false;
        this.gl.deleteSync(sync);
        this.pending = null;
        measure(performance.now());
        return true;
    }

    /** @param {(time: number) => void} measure is told the milliseconds that it took */
    sent(measure) {
        const start = performance.now();
        const sync = this.gl.fenceSync(this.gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
        this.gl.flush();
        this.pending = sync && { sync, measure: (now) => measure(now - start) };
    }

    /** Draws everything once, as well as there is time for. */
    preview() {
        const shots = this.host.shots();
        if (shots.some((shot) => !this.renderer.ready(shot))) return true;
        const fresh = shots.some((shot) => !this.shots.some((old) => old.material === shot.material));
        this.dirty = false;
        this.shots = shots;
        const scale = Math.min(1, Math.sqrt(this.effort));
        const samples = Math.max(1, Math.min(16, Math.round(2 * this.effort)));
        const coarse = shots.map((shot) => resized(shot, scale));
        coarse.forEach((shot, i) => {
            const picture = (this.pictures[0][i] ??= new Picture());
            picture.restart(shot.width, shot.height);
            const scene = { ...shot.scene, shadows: shot.scene.shadows && this.effort > VERY_SLOW };
            const pass = { ...FIRST, samples, total: samples };
            this.renderer.draw({ ...shot, scene }, pass, 0, shot.height);
            this.renderer.add(picture);
        });
        this.present(this.pictures[0].slice(0, shots.length));
        this.plan();
        this.sent((time) => {
            if (fresh) return;  // most of it was the compiler's
            const wanted = this.effort * Math.min(1.5, Math.max(0.3, FRAME / time));
            this.effort = Math.min(MOST_EFFORT, Math.max(LEAST_EFFORT, wanted));
        });
        return true;
    }

    /** What will refine the picture. */
    plan() {
        const { shots } = this;
        const slow = this.effort < SLOW;
        const large = shots.reduce((sum, { width, height }) => sum + width * height, 0) > LARGE;
        const samples = slow && large ? 1 : 4;
        const passes = shots[0].scene.environment ? DIRECTIONS / samples : SUBSAMPLES;
        const phase = (/** @type {number} */ level, /** @type {number} */ scale, /** @type {number} */ most) => ({
            pictures: shots.map((_, i) => (this.pictures[level][i] ??= new Picture())),
            shots: shots.map((shot) => resized(shot, scale)), passes: most, samples, shownFrom: 1,
        });
        this.phases = [phase(2, 1, passes)];
        if (slow && large) {
            this.phases.unshift(phase(1, 0.4, COARSE_PASSES));
            this.phases[1].shownFrom = 4;
        }
        this.row = this.turn = 0;
        this.begun = false;
    }

    begun = false;

    /** @param {Phase} phase */
    refine(phase) {
        const { pictures, shots } = phase;
        if (!this.begun) pictures.forEach((picture, i) => picture.restart(shots[i].width, shots[i].height));
        this.begun = true;
        const [shot, picture] = [shots[this.turn], pictures[this.turn]];
        const [low, high] = rowsOf(shot);
        const bottom = Math.max(this.row, low);
        const top = Math.min(high, bottom + this.rows);
        const number = picture.passes;
        const { samples, passes } = phase;
        const pass = { number, place: PLACES[number % SUBSAMPLES], samples, total: samples * passes };
        this.renderer.draw(shot, pass, this.row ? bottom : 0, top >= high ? shot.height : top);
        this.row = top;
        if (top >= high) {
            this.renderer.add(picture);
            this.row = 0;
            this.turn = (this.turn + 1) % shots.length;
            if (this.turn === 0) this.completed(phase);
        }
        const piece = this.effort < SLOW ? PIECE.slow : PIECE.fast;
        this.sent((time) => {
            const wanted = this.rows * Math.min(2, Math.max(0.5, piece / time));
            this.rows = Math.round(Math.min(8192, Math.max(8, wanted)));
        });
        this.host.stateful(this.phases.length ? "refining" : "done");
    }

    /** @param {Phase} phase of which all pictures have got a pass */
    completed({ pictures, passes, shownFrom }) {
        if (pictures[0].passes >= Math.min(shownFrom, passes)) this.present(pictures);
        if (pictures[0].passes < passes) return;
        this.phases.shift();
        this.begun = false;
    }

    /** @param {Picture[]} pictures */
    present(pictures) {
        this.shown = pictures;
        this.host.present(pictures, this.shots);
    }

    /** Shows again what is shown, in this very task: for reading the canvas. Not where other pictures are wanted now. */
    again() {
        if (this.shown.length === this.host.shots().length) this.present(this.shown);
    }

    dispose() {
        this.stopped = true;
        cancelAnimationFrame(this.request);
        for (const picture of this.pictures.flat()) picture.dispose();
    }
}

/** @param {Shot} shot @param {number} scale @returns {Shot} */
function resized(shot, scale) {
    const [width, height] = [shot.width, shot.height].map((side) => Math.max(1, Math.round(side * scale)));
    return { ...shot, width, height };
}

/**
 * The rows of a shot, from the bottom, in which its mesh may be seen.
 * @param {Shot} shot
 * @returns {[number, number]}
 */
function rowsOf({ camera, scene, width, height }) {
    const { least, greatest } = scene.mesh;
    const corners = Array.from({ length: 8 }, (_, i) => least.map((low, k) => ((i >> k) & 1 ? greatest[k] : low)));
    const rows = corners.map((corner) => height - projected(camera, corner, { width, height })[1]);
    const low = Math.max(0, Math.min(height - 1, Math.floor(Math.min(...rows)) - 2));
    return [low, Math.max(low + 1, Math.min(height, Math.ceil(Math.max(...rows)) + 2))];
}
