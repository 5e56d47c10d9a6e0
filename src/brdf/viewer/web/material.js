// A material on the graphics card: its shader within the stages, its textures, and its parameters as they are set.

import { Program, texture } from "./gl.js";

/**
 * @typedef {import("./payload.js").Stage} Stage
 * @typedef {import("./payload.js").Parameter} Parameter
 * @typedef {{shader: import("./payload.js").Description, text: string,
 *     texels: Uint8Array<ArrayBuffer> | ArrayBuffer | null, lobe?: {alpha: number, share: number}, nbytes?: number,
 *     kind?: string, isotropic?: boolean, note?: string, mask?: Uint8Array | null, mask_shape?: number[]}} Source
 */

/** Where a stage's fragment shader wants the material. */
const PLACE = "// MATERIAL\n";

/** Samples an environment well enough where a material says nothing of itself. */
const LOBE = { alpha: 0.3, share: 0.5 };

/**
 * Numbers within a parameter's bounds, as states and materials keep them.
 * @param {Parameter} parameter
 * @param {number[]} given
 */
export function within({ low, high, size }, given) {
    const values = given.map((x) => Math.min(Math.max(x, low ?? -Infinity), high ?? Infinity));
    return size === 1 ? values[0] : values;
}

export class Material {
    /**
     * @param {WebGL2RenderingContext} gl
     * @param {Source} source
     */
    constructor(gl, source) {
        this.gl = gl;
        this.source = source;
        this.lobe = source.lobe ?? LOBE;
        /** @type {Map<Stage, Program>} */
        this.programs = new Map();
        /** @type {Map<string, WebGLTexture> | null} */
        this.textures = null;
        /** @type {Record<string, number | number[]>} */
        this.values = {};
        this.reset();
    }

    get name() {
        return this.source.shader.name;
    }

    /** What its shader declares, in order. */
    get parameters() {
        return this.source.shader.parameters;
    }

    /** Whether a parameter is not what it was made with. */
    get changed() {
        return this.parameters.some((p) => String(this.values[p.name]) !== String(p.value));
    }

    /**
     * A parameter within its bounds. Throws an Error for a name or a size that it does not have.
     * @param {string} name
     * @param {number | number[]} value
     */
    set(name, value) {
        const parameter = this.parameters.find((p) => p.name === name);
        const given = [value].flat();
        if (!parameter || given.length !== parameter.size || !given.every(Number.isFinite)) {
            throw new Error(`${this.name} has no parameter ${name} that could be ${value}.`);
        }
        this.values[name] = within(parameter, given);
    }

    reset() {
        for (const p of this.parameters) this.values[p.name] = p.value;
    }

    /**
     * The program of a stage around this material.
     * @param {Stage} stage
     */
    program(stage) {
        let program = this.programs.get(stage);
        if (!program) {
            program = new Program(this.gl, stage.vertex, stage.fragment.replace(PLACE, () => this.source.text));
            this.programs.set(stage, program);
        }
        return program;
    }

    /**
     * The same as the current program, with the parameters and textures in place.
     * @param {Stage} stage
     */
    use(stage) {
        const program = this.program(stage).use();
        for (const p of this.parameters) program.set(p.uniform, this.values[p.name]);
        if (!this.textures) {
            const { texels, shader } = this.source;
            const bytes = new Uint8Array(texels ?? new ArrayBuffer(0));
            this.textures = new Map(shader.textures.map((t) => [t.uniform, texture(this.gl, t, bytes)]));
        }
        for (const [name, made] of this.textures) program.bind(name, made);
        return program;
    }

    /** Forgets what a lost context held; the next use makes it anew. */
    forget() {
        this.programs.clear();
        this.textures = null;
    }

    dispose() {
        for (const program of this.programs.values()) program.dispose();
        for (const made of this.textures?.values() ?? []) this.gl.deleteTexture(made);
        this.forget();
    }
}
