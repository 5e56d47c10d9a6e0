// The two materials that are compared, A and B, and their parameters.

import { Material } from "./material.js";

/** @typedef {import("./material.js").Source} Source */

export const NAMES = ["A", "B"];

export class Slots {
    /**
     * @param {WebGL2RenderingContext} gl
     * @param {import("./payload.js").Payload} payload
     */
    constructor(gl, payload) {
        this.gl = gl;
        /** @type {Source[]} */
        this.sources = payload.materials.map((entry) => ({
            ...entry,
            texels: entry.texels && payload.bytes(entry.texels),
            mask: entry.mask && payload.bytes(entry.mask),
        }));
        /** @type {(Material | null)[]} */
        this.materials = [null, null];
        this.reference = payload.comparison;
    }

    /**
     * Makes the materials what a state says. Parameters that a material does not have are passed over.
     * @param {{materials: number[], parameters: Record<string, number | number[]>[]}} state
     */
    follow(state) {
        state.materials.forEach((index, slot) => {
            const source = this.sources[index];
            let material = this.materials[slot];
            if (material?.source !== source) {
                material?.dispose();
                this.materials[slot] = material = new Material(this.gl, source);
            }
            material.reset();
            for (const { name } of material.parameters) {
                const value = state.parameters[slot][name];
                if (value !== undefined && [value].flat().length === [material.values[name]].flat().length) {
                    material.set(name, value);
                }
            }
        });
    }

    /**
     * Takes a material that is already made as A or B; gives the number of its source.
     * @param {number} slot
     * @param {Material} material
     */
    take(slot, material) {
        this.materials[slot]?.dispose();
        this.materials[slot] = material;
        return this.sources.push(material.source) - 1;
    }

    /** @param {number} slot */
    at(slot) {
        return /** @type {Material} */ (this.materials[slot]);
    }

    /** How far B is from A in numbers that came with the page, or null where they are not those two as they were. */
    get comparison() {
        const { reference, sources } = this;
        if (!reference || this.materials.some((material) => material?.changed)) return null;
        const pair = reference.materials ?? [0, 1];
        const shown = this.materials.map((material) => sources.indexOf(/** @type {Material} */ (material).source));
        return pair[0] === shown[0] && pair[1] === shown[1] ? reference : null;
    }

    forget() {
        for (const material of this.materials) material?.forget();
    }

    dispose() {
        for (const material of this.materials) material?.dispose();
    }
}
