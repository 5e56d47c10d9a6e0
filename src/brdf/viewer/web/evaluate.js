// f(wi, wo) of a material for lists of directions, by the same text that draws it.

import { cover, floatTexture, Target } from "./gl.js";

const WIDTH = 512;

/** Directions on the graphics card: evaluated again and again, they are sent there once. */
export class Directions {
    /** @param {Float32Array} list four numbers each: a unit vector, and u or v of the place on the surface */
    constructor(list) {
        this.list = list;
        this.count = list.length / 4;
        /** @type {WebGLTexture | null} */
        this.texture = null;
    }
}

export class Evaluator {
    /**
     * @param {WebGL2RenderingContext} gl
     * @param {{evaluate: import("./payload.js").Stage}} stages
     */
    constructor(gl, stages) {
        this.gl = gl;
        this.stage = stages.evaluate;
        /** @type {Target | null} */
        this.target = null;
        /** @type {Set<Directions>} */
        this.known = new Set();
    }

    /**
     * f [1/sr] as RGBA of each pair; `wi` and `wo` hold four numbers a pair, (x, y, z, u) and (x, y, z, v).
     * What is given as Directions stays on the card until `drop`.
     * @param {import("./material.js").Material} material
     * @param {Float32Array | Directions} wi
     * @param {Float32Array | Directions} wo
     * @returns {Float32Array}
     */
    evaluate(material, wi, wo) {
        const { gl } = this;
        const lists = [wi, wo].map((list) => (list instanceof Directions ? list : new Directions(list)));
        const count = lists[0].count;
        if (lists[1].count !== count || count % 1) throw new Error("wi and wo must be lists of the same length.");
        if (!count) return new Float32Array(0);
        const height = Math.ceil(count / WIDTH);
        const program = material.use(this.stage);
        program.bind("given_wi", this.placed(lists[0])).bind("given_wo", this.placed(lists[1]));
        if (!this.target || this.target.height < height) {
            this.target?.dispose();
            this.target = new Target(gl, WIDTH, height, false, true);
        }
        this.target.use(WIDTH, height);
        gl.disable(gl.DEPTH_TEST);
        gl.disable(gl.BLEND);
        gl.disable(gl.SCISSOR_TEST);
        cover(gl);
        const values = new Float32Array(WIDTH * height * 4);
        gl.readPixels(0, 0, WIDTH, height, gl.RGBA, gl.FLOAT, values);
        for (const list of lists) if (list !== wi && list !== wo) this.drop(list);
        return values.subarray(0, count * 4);
    }

    /** @param {Directions} list */
    placed(list) {
        list.texture ??= floatTexture(this.gl, list.list, 4, WIDTH);
        this.known.add(list);
        return list.texture;
    }

    /** @param {Directions} list */
    drop(list) {
        this.gl.deleteTexture(list.texture);
        list.texture = null;
        this.known.delete(list);
    }

    /** Forgets what a lost context held. */
    forget() {
        this.target = null;
        for (const list of this.known) list.texture = null;
        this.known.clear();
    }

    dispose() {
        for (const list of [...this.known]) this.drop(list);
        this.target?.dispose();
        this.target = null;
    }
}
