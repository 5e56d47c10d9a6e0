// Draws what a scene's materials reflect: passes, their mean, and the picture on the screen.

import { cameraUniforms } from "./camera.js";
import { cover, floatTexture, Program, Target } from "./gl.js";
import { ADD, BACKGROUNDS, COVER, presentation, SHOWN } from "./present.js";
import { MOST_LIGHTS } from "./state.js";
import { direction, RADIANS } from "./vector.js";

/**
 * @typedef {import("./camera.js").Camera} Camera
 * @typedef {import("./camera.js").Rectangle} Rectangle
 * @typedef {import("./material.js").Material} Material
 * @typedef {{kind: string, power: number[], theta?: number, phi?: number, position?: number[]}} Light
 * @typedef {import("./environment.js").Environment} Environment
 * @typedef {{mesh: import("./mesh.js").Mesh, lights: Light[], environment: Environment | null, turn: number,
 *     strength: number, shadows: boolean}} Scene `turn` in degrees about +y
 * @typedef {{scene: Scene, material: Material, camera: Camera, width: number, height: number}} Shot
 * @typedef {{number: number, place: [number, number], samples: number, total: number}} Pass `place` within the
 *     pixel; `total`: of samples, after all passes
 */

const LIST_WIDTH = 2048;  // texels of a row, as texel.glsl reads lists

/** The mean of passes over one shot, of which the lower left `width` x `height` pixels are drawn. */
export class Picture {
    constructor() {
        /** @type {Target | null} */
        this.mean = null;
        this.passes = 0;
        this.width = 0;
        this.height = 0;
    }

    /** Begins anew with another size. @param {number} width @param {number} height */
    restart(width, height) {
        this.passes = 0;
        this.width = width;
        this.height = height;
    }

    dispose() {
        this.mean?.dispose();
        this.mean = null;
    }
}

export class Renderer {
    /** @type {WeakMap<object, Record<string, WebGLTexture>>} */
    lists = new WeakMap();
    /** @type {Target | null} */
    pass = null;
    /** @type {Program | null} */
    adding = null;
    /** @type {Program | null} */
    presenting = null;
    /** @type {Program | null} */
    depth = null;
    /** @type {WebGLTexture | null} */
    nothing = null;

    /**
     * @param {WebGL2RenderingContext} gl
     * @param {import("./payload.js").Contents["stages"]} stages
     */
    constructor(gl, stages) {
        this.gl = gl;
        this.stages = stages;
        const plain = (/** @type {import("./payload.js").Stage} */ { vertex, fragment }) =>
            ({ vertex, fragment: `#define LIGHTS_ALONE\n${fragment}` });
        /** The same without an environment: smaller and faster programs. */
        this.plain = { sphere: plain(stages.sphere), mesh: plain(stages.mesh) };
    }

    /** Forgets what a lost context held; what is needed is made anew. */
    forget() {
        this.lists = new WeakMap();
        this.pass = this.adding = this.presenting = this.depth = this.nothing = null;
    }

    /** @param {object} owner @param {Record<string, [Float32Array, number, number]>} lists numbers, channels, width */
    textures(owner, lists) {
        const made = this.lists.get(owner) ?? {};
        this.lists.set(owner, made);
        for (const [name, [numbers, channels, width]] of Object.entries(lists)) {
            made[name] ??= floatTexture(this.gl, numbers, channels, width);
        }
        return made;
    }

    /** A texture for samplers that nothing is read from. */
    get empty() {
        return (this.nothing ??= floatTexture(this.gl, new Float32Array(4), 4, 1));
    }

    /** Whether a shot can be drawn without waiting for the compiler. @param {Shot} shot */
    ready(shot) {
        return shot.material.program(this.stageOf(shot.scene)).ready;
    }

    /** @param {Scene} scene */
    stageOf({ mesh, environment }) {
        const shape = mesh.exact ? "sphere" : "mesh";
        return environment ? this.stages[shape] : this.plain[shape];
    }

    /**
     * Draws rows [bottom, top) of a pass over a shot; `top` is its height where the pass is to be completed.
     * @param {Shot} shot
     * @param {Pass} pass
     * @param {number} bottom
     * @param {number} top
     */
    draw(shot, pass, bottom, top) {
        const { gl } = this;
        const { width, height, material, scene } = shot;
        if (!this.pass || this.pass.width < width || this.pass.height < height) {
            const [w, h] = [Math.max(width, this.pass?.width ?? 0), Math.max(height, this.pass?.height ?? 0)];
            this.pass?.dispose();
            this.pass = new Target(gl, w, h, true);
        }
        this.pass.use(width, height);
        gl.disable(gl.BLEND);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(0, bottom, width, top - bottom);
        gl.clearColor(0, 0, 0, 0);
        gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
        const { exact, faces } = scene.mesh;
        if (!exact) {  // first depth alone, so that only what is seen is shaded
            const { vertex, fragment } = this.stages.depth;
            this.depth ??= new Program(gl, vertex, fragment);
            this.place(this.depth.use(), shot, pass);
            gl.enable(gl.DEPTH_TEST);
            gl.depthFunc(gl.LEQUAL);
            gl.colorMask(false, false, false, false);
            gl.drawArrays(gl.TRIANGLES, 0, faces * 3);
            gl.colorMask(true, true, true, true);
        }
        this.place(material.use(this.stageOf(scene)), shot, pass);
        gl.drawArrays(gl.TRIANGLES, 0, exact ? 3 : faces * 3);
        gl.disable(gl.SCISSOR_TEST);
        gl.disable(gl.DEPTH_TEST);
    }

    /** @param {Program} program @param {Shot} shot @param {Pass} pass */
    place(program, { scene, camera, material, width, height }, pass) {
        const { mesh, environment } = scene;
        program.setAll(cameraUniforms(camera, mesh)).setAll({
            picture_size: [width, height],
            sample_place: pass.place,
            ...lightUniforms(scene.lights),
            ...environmentUniforms(scene),
            environment_samples: environment ? pass.samples : 0,
            environment_pass: pass.number,
            environment_total: pass.total,
            environment_dealt: true,
            lobe_alpha: material.lobe.alpha,
            lobe_share: material.lobe.share,
            mesh_has_uv: mesh.hasUv,
            mesh_nudge: mesh.nudge,
            mesh_node_count: scene.shadows ? mesh.nodes.length / 8 : 0,
        });
        if (!mesh.exact) {
            const lists = { mesh_faces: [mesh.texels, 4, LIST_WIDTH], mesh_nodes: [mesh.nodes, 4, LIST_WIDTH] };
            const made = this.textures(mesh, /** @type {any} */ (lists));
            for (const name of Object.keys(lists)) program.bind(name, made[name]);
        }
        const made = environment && this.textures(environment, {
            environment_map: [environment.map, 4, environment.width],
            environment_directions: [environment.directions, 2, 256],
        });
        for (const name of ["environment_map", "environment_directions"]) {
            program.bind(name, made ? made[name] : this.empty);
        }
    }

    /**
     * Takes the pass that was drawn into a picture's mean.
     * @param {Picture} picture
     */
    add(picture) {
        const { gl } = this;
        const { width, height } = picture;
        if (!picture.mean || picture.mean.width < width || picture.mean.height < height) {
            picture.dispose();
            picture.mean = new Target(gl, width, height);
            picture.passes = 0;
        }
        this.adding ??= new Program(gl, COVER, ADD);
        this.adding.use().bind("pass", /** @type {Target} */ (this.pass).texture);
        picture.mean.use(width, height);
        if (picture.passes) {
            gl.enable(gl.BLEND);
            gl.blendColor(0, 0, 0, 1 / (picture.passes + 1));
            gl.blendFunc(gl.CONSTANT_ALPHA, gl.ONE_MINUS_CONSTANT_ALPHA);
        }
        cover(gl);
        gl.disable(gl.BLEND);
        picture.passes++;
    }

    /**
     * Shows one picture, or two of the same size compared, at a place of the canvas.
     * @param {Rectangle} place in pixels of the canvas, from its lower left corner
     * @param {Picture} first
     * @param {Picture} second
     * @param {Shot} shot
     * @param {{shown: keyof typeof SHOWN, divider: number, gain: number, exposure: number, tone: number,
     *     background: keyof typeof BACKGROUNDS, plain: number[]}} how
     */
    present(place, first, second, shot, how) {
        const { gl } = this;
        const { environment } = shot.scene;
        this.presenting ??= new Program(gl, COVER, presentation(this.stages.tone));
        const program = this.presenting.use();
        const around = how.background === "environment" ? environment?.backdrop : undefined;
        const backdrop = around && this.textures(around, { map: [around.map, 4, around.width] });
        program.setAll({
            ...cameraUniforms(shot.camera, shot.scene.mesh),
            ...environmentUniforms(shot.scene),
            first_size: [first.width, first.height],
            second_size: [second.width, second.height],
            place: [place.x, place.y, place.width, place.height],
            shown: SHOWN[how.shown],
            background: BACKGROUNDS[around ? "environment" : how.background === "plain" ? "plain" : "gradient"],
            divider: how.divider,
            gain: how.gain,
            plain: how.plain,
            exposure: 2 ** how.exposure,
            tone_curve: how.tone,
        });
        program.bind("first", first.mean?.texture ?? this.empty).bind("second", second.mean?.texture ?? this.empty);
        program.bind("backdrop", backdrop ? backdrop.map : this.empty);
        gl.bindFramebuffer(gl.FRAMEBUFFER, null);
        gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
        gl.enable(gl.SCISSOR_TEST);
        gl.scissor(place.x, place.y, place.width, place.height);
        cover(gl);
        gl.disable(gl.SCISSOR_TEST);
    }

    dispose() {
        this.pass?.dispose();
        this.adding?.dispose();
        this.presenting?.dispose();
        this.depth?.dispose();
    }
}

/** @param {Light[]} lights */
function lightUniforms(lights) {
    const shown = lights.slice(0, MOST_LIGHTS);
    const filled = (/** @type {number[][]} */ rows, /** @type {number} */ size) =>
        Float32Array.from({ length: MOST_LIGHTS * size }, (_, i) => rows.flat()[i] ?? 0);
    const places = shown.map((light) => (light.kind === "point"
        ? [.../** @type {number[]} */ (light.position), 1]
        : [...direction(light.theta ?? 0, light.phi ?? 0), 0]));
    const irradiances = shown.map((light) => light.power.map((power) => Math.PI * power));
    return { light_count: shown.length, light_place: filled(places, 4), light_irradiance: filled(irradiances, 3) };
}

/** @param {Scene} scene */
function environmentUniforms({ turn, strength }) {
    const angle = turn * RADIANS;
    return { environment_turn: [Math.cos(angle), Math.sin(angle)], environment_scale: strength };
}
