// Light from all around: the texels that environment.glsl reads, and the directions that it draws by brightness.

/**
 * @typedef {{name: string, width: number, height: number, map: Float32Array, directions: Float32Array,
 *     backdrop: {width: number, height: number, map: Float32Array}}} Environment
 *     `map`: radiance and density over solid angle [1/sr]; `directions`: places (u, v); `backdrop`: out of focus.
 */

const LIST_SIDE = 256;  // of the square of numbers, to each of which a direction belongs
const BACKDROP_HEIGHT = 32;
const LUMINANCE = [0.2126, 0.7152, 0.0722];

/**
 * @param {import("./payload.js").EnvironmentEntry} entry
 * @param {import("./payload.js").Payload} payload
 * @returns {Environment}
 */
export function decodedEnvironment(entry, payload) {
    const { name, width, height } = entry;
    const bytes = payload.numbers(entry.pixels);  // r, g, b and a common exponent
    const map = new Float32Array(width * height * 4);
    for (let i = 0; i < map.length; i++) map[i] = i % 4 < 3 ? bytes[i] * 2 ** (bytes[i | 3] - 136) : 0;
    const backdrop = blurred(map, width, height);
    return { name, width, height, map, directions: drawn(map, width, height), backdrop };
}

/**
 * Sets the densities in `map`, and draws directions by them. A cell's brightness is the mean of the bilinear
 * interpolation over it, so that light which leaks into a dark cell from its neighbours is found, too.
 * @param {Float32Array} map
 * @param {number} width
 * @param {number} height
 */
function drawn(map, width, height) {
    const at = (/** @type {number} */ row, /** @type {number} */ column) => {
        const texel = (Math.min(Math.max(row, 0), height - 1) * width + ((column + width) % width)) * 4;
        return LUMINANCE[0] * map[texel] + LUMINANCE[1] * map[texel + 1] + LUMINANCE[2] * map[texel + 2];
    };
    const across = (/** @type {number} */ row, /** @type {number} */ column) =>
        (at(row, column - 1) + 6 * at(row, column) + at(row, column + 1)) / 8;
    const edge = (/** @type {number} */ row) => Math.cos((row * Math.PI) / height);
    const columns = new Float64Array(width * height);  // running sums of shares along each row
    const rows = new Float64Array(height);
    let total = 0;
    for (let row = 0; row < height; row++) {
        const solid = ((edge(row) - edge(row + 1)) * 2 * Math.PI) / width;
        let sum = 0;
        for (let column = 0; column < width; column++) {
            const mean = (across(row - 1, column) + 6 * across(row, column) + across(row + 1, column)) / 8;
            map[(row * width + column) * 4 + 3] = mean;
            columns[row * width + column] = sum += mean * solid;
        }
        rows[row] = total += sum;
    }
    for (let i = 3; i < map.length; i += 4) map[i] /= total;
    const places = new Float32Array(LIST_SIDE * LIST_SIDE * 2);
    let row = 0;
    for (let i = 0; i < LIST_SIDE; i++) {
        const wanted = ((i + 0.5) / LIST_SIDE) * total;
        while (rows[row] < wanted && row < height - 1) row++;
        const before = row ? rows[row - 1] : 0;
        const down = Math.min(1, (wanted - before) / (rows[row] - before || 1));
        const place = Math.acos(edge(row) + down * (edge(row + 1) - edge(row))) / Math.PI;
        const line = columns.subarray(row * width, (row + 1) * width);
        for (let j = 0; j < LIST_SIDE; j++) {
            const part = ((j + 0.5) / LIST_SIDE) * line[width - 1];
            const column = firstAbove(line, part);
            const left = column ? line[column - 1] : 0;
            const right = Math.min(1, (part - left) / (line[column] - left || 1));
            places.set([(column + right) / width, place], 2 * (i * LIST_SIDE + j));
        }
    }
    return places;
}

/** @param {Float64Array} sums @param {number} wanted */
function firstAbove(sums, wanted) {
    let [low, high] = [0, sums.length - 1];
    while (low < high) {
        const middle = (low + high) >> 1;
        if (sums[middle] > wanted) high = middle;
        else low = middle + 1;
    }
    return low;
}

/**
 * The same light averaged down to about 32 rows and smoothed twice, as brdf.render.Environment.blurred.
 * @param {Float32Array} map
 * @param {number} width
 * @param {number} height
 */
function blurred(map, width, height) {
    const factor = Math.max(1, Math.floor(height / BACKDROP_HEIGHT));
    const [w, h] = [Math.floor(width / factor), Math.floor(height / factor)];
    let small = new Float32Array(w * h * 4);
    const weights = new Float32Array(h);
    for (let y = 0; y < h * factor; y++) {
        const weight = Math.sin(((y + 0.5) * Math.PI) / (h * factor));
        weights[Math.floor(y / factor)] += weight * factor;
        for (let x = 0; x < w * factor; x++) {
            const to = (Math.floor(y / factor) * w + Math.floor(x / factor)) * 4;
            for (let k = 0; k < 3; k++) small[to + k] += weight * map[(y * width + x) * 4 + k];
        }
    }
    small = small.map((value, i) => value / weights[Math.floor(i / 4 / w)]);
    for (let round = 0; round < 2; round++) {
        const wide = small.map((value, i) => {
            const [row, column] = [Math.floor(i / 4 / w), Math.floor(i / 4) % w];
            const beside = (/** @type {number} */ step) => small[(row * w + ((column + step + w) % w)) * 4 + (i % 4)];
            return (beside(-1) + 2 * value + beside(1)) / 4;
        });
        small = wide.map((value, i) => {
            const above = i < 4 * w ? value : wide[i - 4 * w];
            const below = i >= wide.length - 4 * w ? value : wide[i + 4 * w];
            return (above + 2 * value + below) / 4;
        });
    }
    return { width: w, height: h, map: small };
}
