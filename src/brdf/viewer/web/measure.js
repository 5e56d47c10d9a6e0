// The number beside a comparison: what came with the page, or is worked out here when the sliders rest.

import { Comparer } from "./metrics.js";

const PAUSE = 300;  // milliseconds

export class Measure {
    /**
     * @param {import("./evaluate.js").Evaluator} evaluator
     * @param {import("./slots.js").Slots} slots
     * @param {() => void} known is called when the number has been worked out
     * @param {(error: unknown) => void} failed
     */
    constructor(evaluator, slots, known, failed) {
        this.evaluator = evaluator;
        this.slots = slots;
        this.known = known;
        this.failed = failed;
        /** PSNR of B against A [dB], or null while it is not known. @type {number | null} */
        this.psnr = null;
        this.key = "";
        /** @type {ReturnType<typeof setTimeout> | undefined} */
        this.timer = undefined;
        /** @type {Comparer | null} */
        this.comparer = null;
    }

    /** Follows the materials as they are. @param {boolean} wanted whether two are compared at all */
    follow(wanted) {
        const [a, b] = this.slots.materials;
        const both = [a, b].map((m) => m && [this.slots.sources.indexOf(m.source), m.values]);
        const key = wanted ? JSON.stringify(both) : "";
        if (key === this.key) return;
        this.key = key;
        clearTimeout(this.timer);
        const given = wanted ? this.slots.comparison : null;
        this.psnr = given ? given.psnr ?? Infinity : null;
        if (wanted && !given) this.timer = setTimeout(() => this.measure(), PAUSE);
    }

    measure() {
        if (this.evaluator.gl.isContextLost()) return void (this.key = "");  // so that it is asked for again
        try {
            this.comparer ??= new Comparer(this.evaluator);
            this.psnr = this.comparer.psnr(this.slots.at(0), this.slots.at(1));
            this.known();
        } catch (error) {
            this.failed(error);
        }
    }

    dispose() {
        clearTimeout(this.timer);
        this.comparer?.dispose();
    }
}
