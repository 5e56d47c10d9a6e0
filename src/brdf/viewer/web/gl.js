// Programs, textures and targets of WebGL2, with errors that can be read.

const VERSION_LINE = "#version 300 es\n";

/** Textures are made on the last unit that every card has; programs use the first ones. */
const SCRATCH_UNIT = 31;

/** @typedef {number | boolean | ArrayLike<number>} Value */
/** @typedef {{name: string, place: WebGLUniformLocation, type: number, unit: number}} Uniform */

/** A linked program and its uniforms by name; each sampler has a texture unit of its own. */
export class Program {
    /**
     * Starts to compile; what is wrong is found by the first `use()`, so that browsers may compile beside the page.
     * @param {WebGL2RenderingContext} gl
     * @param {string} vertex
     * @param {string} fragment
     */
    constructor(gl, vertex, fragment) {
        this.gl = gl;
        this.program = gl.createProgram();
        this.shaders = [gl.VERTEX_SHADER, gl.FRAGMENT_SHADER].map((kind, i) => {
            const shader = /** @type {WebGLShader} */ (gl.createShader(kind));
            gl.shaderSource(shader, VERSION_LINE + [vertex, fragment][i]);
            gl.compileShader(shader);
            gl.attachShader(this.program, shader);
            return shader;
        });
        gl.linkProgram(this.program);
        /** @type {Map<string, Uniform> | null} */
        this.uniforms = null;
    }

    /** Whether using it needs no wait. */
    get ready() {
        const extension = this.gl.getExtension("KHR_parallel_shader_compile");
        if (this.uniforms || !extension) return true;
        return Boolean(this.gl.getProgramParameter(this.program, extension.COMPLETION_STATUS_KHR));
    }

    /** Makes it the current one. Throws an Error that quotes the line which does not compile. */
    use() {
        if (!this.uniforms) this.uniforms = this.linked();
        this.gl.useProgram(this.program);
        return this;
    }

    /** @returns {Map<string, Uniform>} */
    linked() {
        const { gl, program } = this;
        if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
            const log = this.shaders.map((shader) => complaint(gl, shader)).find(Boolean);
            throw new Error(log || gl.getProgramInfoLog(program) || "The shaders do not fit.");
        }
        const found = new Map();
        let units = 0;
        const count = gl.isContextLost() ? 0 : gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS);
        gl.useProgram(program);
        for (let i = 0; i < count; i++) {
            const { name, type } = /** @type {WebGLActiveInfo} */ (gl.getActiveUniform(program, i));
            const plain = name.replace("[0]", "");
            const place = /** @type {WebGLUniformLocation} */ (gl.getUniformLocation(program, name));
            const samples = type === gl.SAMPLER_2D || type === gl.SAMPLER_3D;
            if (samples) gl.uniform1i(place, units);
            found.set(plain, { name: plain, place, type, unit: samples ? units++ : -1 });
        }
        for (const shader of this.shaders) gl.deleteShader(shader);
        return found;
    }

    /**
     * Sets a uniform of the current program; those that it does not have are passed over.
     * @param {string} name
     * @param {Value} value
     */
    set(name, value) {
        const { gl } = this;
        const uniform = this.uniforms?.get(name);
        if (!uniform) return this;
        const { place, type } = uniform;
        const list = typeof value === "object" ? Array.from(value) : [Number(value)];
        if (type === gl.FLOAT) gl.uniform1fv(place, list);
        else if (type === gl.FLOAT_VEC2) gl.uniform2fv(place, list);
        else if (type === gl.FLOAT_VEC3) gl.uniform3fv(place, list);
        else if (type === gl.FLOAT_VEC4) gl.uniform4fv(place, list);
        else if (type === gl.FLOAT_MAT3) gl.uniformMatrix3fv(place, false, list);
        else gl.uniform1iv(place, list);
        return this;
    }

    /** @param {Record<string, Value>} values */
    setAll(values) {
        for (const name in values) this.set(name, values[name]);
        return this;
    }

    /**
     * What a sampler of the current program reads.
     * @param {string} name
     * @param {WebGLTexture | null} texture
     */
    bind(name, texture) {
        const { gl } = this;
        const uniform = this.uniforms?.get(name);
        if (!uniform) return this;
        gl.activeTexture(gl.TEXTURE0 + uniform.unit);
        gl.bindTexture(uniform.type === gl.SAMPLER_3D ? gl.TEXTURE_3D : gl.TEXTURE_2D, texture);
        return this;
    }

    dispose() {
        this.gl.deleteProgram(this.program);
    }
}

/**
 * The compiler's first message and the line it means, or "".
 * @param {WebGL2RenderingContext} gl
 * @param {WebGLShader} shader
 */
function complaint(gl, shader) {
    const log = gl.getShaderInfoLog(shader) || "";
    const found = /ERROR: \d+:(\d+): *(.*)/.exec(log);
    if (gl.getShaderParameter(shader, gl.COMPILE_STATUS)) return "";
    if (!found) return log || "A shader does not compile.";
    const line = (gl.getShaderSource(shader) || "").split("\n")[Number(found[1]) - 1] || "";
    return `A shader does not compile: ${found[2]} in line ${found[1]}: ${line.trim()}`;
}

/**
 * A texture as a shader's description says, read by texel: neither filtered nor repeated.
 * @param {WebGL2RenderingContext} gl
 * @param {import("./payload.js").TextureDescription} description
 * @param {Uint8Array<ArrayBuffer>} texels of all textures of the shader
 */
export function texture(gl, description, texels) {
    const { target, size, offset, bytes } = description;
    if (offset + bytes > texels.byteLength) throw new Error(`The texels of ${description.uniform} are cut short.`);
    const place = /** @type {"TEXTURE_2D" | "TEXTURE_3D"} */ (target);
    const [format, type, internal] = [description.format, description.type, description.internal_format].map(
        (name) => /** @type {any} */ (gl)[name],
    );
    const data = typed(gl, type, texels.slice(offset, offset + bytes).buffer);
    const made = plainTexture(gl, gl[place]);
    if (target === "TEXTURE_3D") {
        gl.texImage3D(gl.TEXTURE_3D, 0, internal, size[0], size[1], size[2], 0, format, type, data);
    } else {
        gl.texImage2D(gl.TEXTURE_2D, 0, internal, size[0], size[1], 0, format, type, data);
    }
    return made;
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} type
 * @param {ArrayBuffer} buffer
 */
function typed(gl, type, buffer) {
    if (type === gl.UNSIGNED_BYTE) return new Uint8Array(buffer);
    if (type === gl.HALF_FLOAT) return new Uint16Array(buffer);
    return type === gl.FLOAT ? new Float32Array(buffer) : new Uint32Array(buffer);
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {number} target
 */
function plainTexture(gl, target) {
    const made = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0 + SCRATCH_UNIT);
    gl.bindTexture(target, made);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    for (const filter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(target, filter, gl.NEAREST);
    for (const wrap of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T, gl.TEXTURE_WRAP_R]) {
        gl.texParameteri(target, wrap, gl.CLAMP_TO_EDGE);
    }
    return made;
}

/**
 * A texture of floats with 2 or 4 channels; a list is laid in rows of `width` texels, the last one filled up.
 * @param {WebGL2RenderingContext} gl
 * @param {Float32Array} data
 * @param {number} channels
 * @param {number} width
 */
export function floatTexture(gl, data, channels, width) {
    const height = Math.max(1, Math.ceil(data.length / channels / width));
    const most = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    if (height > most || width > most) throw new Error("Too much data for this graphics card.");
    const full = new Float32Array(width * height * channels);
    full.set(data);
    const made = plainTexture(gl, gl.TEXTURE_2D);
    const [internal, format] = channels === 4 ? [gl.RGBA32F, gl.RGBA] : [gl.RG32F, gl.RG];
    gl.texImage2D(gl.TEXTURE_2D, 0, internal, width, height, 0, format, gl.FLOAT, full);
    return made;
}

/** A picture of floats to draw into. */
export class Target {
    /**
     * @param {WebGL2RenderingContext} gl
     * @param {number} width
     * @param {number} height
     * @param {boolean} deep with a depth buffer
     * @param {boolean} full single precision, else as much as can be blended
     */
    constructor(gl, width, height, deep = false, full = false) {
        this.gl = gl;
        this.width = width;
        this.height = height;
        this.texture = plainTexture(gl, gl.TEXTURE_2D);
        gl.texStorage2D(gl.TEXTURE_2D, 1, floatFormat(gl, full), width, height);
        this.framebuffer = gl.createFramebuffer();
        gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.texture, 0);
        this.depth = deep ? gl.createRenderbuffer() : null;
        if (!this.depth) return;
        gl.bindRenderbuffer(gl.RENDERBUFFER, this.depth);
        gl.renderbufferStorage(gl.RENDERBUFFER, gl.DEPTH_COMPONENT24, width, height);
        gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.RENDERBUFFER, this.depth);
    }

    /** Draws go here, to its lower left `width` x `height` pixels. */
    use(width = this.width, height = this.height) {
        this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, this.framebuffer);
        this.gl.viewport(0, 0, width, height);
        return this;
    }

    dispose() {
        this.gl.deleteFramebuffer(this.framebuffer);
        this.gl.deleteRenderbuffer(this.depth);
        this.gl.deleteTexture(this.texture);
    }
}

/**
 * @param {WebGL2RenderingContext} gl
 * @param {boolean} full
 */
function floatFormat(gl, full) {
    const floats = gl.getExtension("EXT_color_buffer_float");
    if (floats && (full || gl.getExtension("EXT_float_blend"))) return gl.RGBA32F;
    if (!full && (floats || gl.getExtension("EXT_color_buffer_half_float"))) return gl.RGBA16F;
    throw new Error("This browser's WebGL cannot draw floating-point pictures.");
}

/**
 * One triangle over the whole target, for programs whose vertex shader is that of the stage `sphere`.
 * @param {WebGL2RenderingContext} gl
 */
export function cover(gl) {
    gl.drawArrays(gl.TRIANGLES, 0, 3);
}
