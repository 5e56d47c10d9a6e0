// What is looked at and how, as plain data: the address bar, notebooks and tests read and write it.

/**
 * @typedef {{kind: string, power: number[], theta?: number, phi?: number, position?: number[]}} Light
 * @typedef {{
 *     materials: number[], parameters: Record<string, number | number[]>[],
 *     compare: string, divider: number, gain: number,
 *     mesh: string, theta: number, phi: number, zoom: number, pan: number[],
 *     lights: Light[], environment: string | null, turn: number, strength: number, shadows: boolean,
 *     exposure: number, tone: string, background: string, view: string | null}} State
 *     `materials`: which are A and B; `parameters`: of A and of B what is not as it was; angles in degrees
 */

export const COMPARISONS = ["first", "second", "split", "side", "difference"];
export const TONES = ["clip", "reinhard", "filmic", "neutral", "linear"];
export const BACKDROPS = ["gradient", "environment", "plain"];
export const MOST_LIGHTS = 8;

/** Bounds of numbers. @type {Record<string, [number, number]>} */
export const RANGES = {
    divider: [0, 1],
    gain: [1, 256],
    theta: [1, 179],
    zoom: [0.2, 20],
    strength: [0.01, 100],
    exposure: [-10, 10],
};

/**
 * @param {import("./payload.js").Payload} payload
 * @returns {State}
 */
export function initialState(payload) {
    const several = payload.materials.length > 1;
    const state = {
        materials: [0, several ? 1 : 0], parameters: [{}, {}], compare: several ? "split" : "first", divider: 0.5,
        gain: 8, mesh: payload.meshes[0].name, theta: 68, phi: 20, zoom: 1, pan: [0, 0], lights: [],
        environment: payload.environments[0]?.name ?? null, turn: 0, strength: 1, shadows: true, exposure: 0,
        tone: "filmic", background: "gradient", view: null,
    };
    return merged(state, payload.state ?? {}, payload);
}

/**
 * The state with what is valid of a patch, which may come from anywhere; the rest of the patch is passed over.
 * @param {State} state
 * @param {Record<string, any>} patch
 * @param {import("./payload.js").Payload} payload
 * @returns {State}
 */
export function merged(state, patch, payload) {
    const next = /** @type {any} */ ({ ...state });
    for (const [key, value] of Object.entries(patch)) {
        const valid = Object.hasOwn(next, key) ? validated(key, value, payload) : undefined;
        if (valid !== undefined) next[key] = valid;
    }
    return next;
}

/**
 * @param {string} key
 * @param {any} value
 * @param {import("./payload.js").Payload} payload
 */
function validated(key, value, payload) {
    if (key === "phi" || key === "turn") return Number.isFinite(value) ? value % 360 : undefined;
    if (RANGES[key]) return Number.isFinite(value) ? clamped(value, RANGES[key]) : undefined;
    const one = (/** @type {any[]} */ allowed) => (allowed.includes(value) ? value : undefined);
    const named = (/** @type {{name: string}[]} */ entries) => one(entries.map((entry) => entry.name));
    switch (key) {
        case "compare": return one(COMPARISONS);
        case "tone": return one(TONES);
        case "background": return one(BACKDROPS);
        case "mesh": return named(payload.meshes);
        case "environment": return value === null ? null : named(payload.environments);
        case "shadows": return typeof value === "boolean" ? value : undefined;
        case "view": return value === null || typeof value === "string" ? value : undefined;
        case "pan": return numbers(value, 2)?.map((x) => clamped(x, [-2, 2]));
        case "materials": {
            return numbers(value, 2)?.every((i) => i in payload.materials) ? value : undefined;
        }
        case "parameters": return Array.isArray(value) && value.length === 2 ? value.map(plainNumbers) : undefined;
        case "lights": return Array.isArray(value) ? value.map(light).filter(Boolean).slice(0, MOST_LIGHTS) : undefined;
        default: return undefined;
    }
}

/** @param {number} value @param {[number, number]} range */
export function clamped(value, [low, high]) {
    return Math.min(Math.max(value, low), high);
}

/** @param {any} value @param {number} size @returns {number[] | undefined} */
function numbers(value, size) {
    return Array.isArray(value) && value.length === size && value.every(Number.isFinite) ? value : undefined;
}

/** @param {any} values @returns {Record<string, number | number[]>} */
function plainNumbers(values) {
    const usable = (/** @type {any} */ v) => Number.isFinite(v) || (Array.isArray(v) && v.every(Number.isFinite));
    return Object.fromEntries(Object.entries(values ?? {}).filter(([, value]) => usable(value)));
}

/** @param {any} given @returns {Light | null} */
function light(given) {
    const power = numbers(given?.power, 3)?.map((p) => clamped(p, [0, 1e15]));
    if (!power) return null;
    if (given.kind === "point") {
        const position = numbers(given.position, 3);
        return position ? { kind: "point", position, power } : null;
    }
    const { theta, phi } = given;
    return Number.isFinite(theta) && Number.isFinite(phi) ? { kind: "directional", theta, phi, power } : null;
}

/**
 * What differs from another state, for the address: `key=value` with the values in JSON.
 * @param {State} state
 * @param {State} from
 */
export function encoded(state, from) {
    return Object.entries(state)
        .map(([key, value]) => [key, written(value), written(/** @type {any} */ (from)[key])])
        .filter(([, value, old]) => value !== old)
        .map(([key, value]) => `${key}=${encodeURIComponent(value).replaceAll("%2C", ",").replaceAll("%3A", ":")}`)
        .join("&");
}

/** @param {any} value */
function written(value) {
    return JSON.stringify(value, (_, v) => (typeof v === "number" ? Number(v.toPrecision(5)) : v));
}

/**
 * The patch that an address holds; what is not readable is passed over.
 * @param {string} hash
 */
export function decodedHash(hash) {
    /** @type {Record<string, any>} */
    const patch = {};
    for (const part of hash.replace(/^#/, "").split("&")) {
        const at = part.indexOf("=");
        if (at < 1) continue;
        try {
            patch[part.slice(0, at)] = JSON.parse(decodeURIComponent(part.slice(at + 1)));
        } catch {
            continue;  // somebody else's, or cut
        }
    }
    return patch;
}
