// The pinhole camera of brdf.render.Camera, and the one that sees the whole of a shape.

import { cross, direction, dot, plus, RADIANS, unit } from "./vector.js";

/**
 * @typedef {import("./vector.js").Vector} Vector
 * @typedef {{position: Vector, target: Vector, frame: [Vector, Vector, Vector], fov: number}} Camera
 *     `frame`: unit vectors to the right, up, and backwards.
 * @typedef {{x: number, y: number, width: number, height: number}} Rectangle
 */

const FOV = 30;

/** By how much larger than needed the picture is. */
const MARGIN = 1.1;

/** What the camera sees first, as in Python: degrees from +y, and from +z towards +x. */
const HOME = { theta: 68, phi: 20 };

/** @param {number} theta @param {number} phi @returns {[Vector, Vector, Vector]} */
function frameOf(theta, phi) {
    const backwards = direction(theta, phi);
    const right = unit(cross([0, 1, 0], backwards));
    return [right, cross(backwards, right), backwards];
}

/**
 * Where the camera has to look, and from how far, to see all points within `slopes`: the tangents of the angles from
 * the middle to the edges of what is free in the picture.
 * @param {Float32Array} points x, y, z of each
 * @param {[number, number]} slopes
 * @returns {{target: Vector, distance: number}}
 */
export function framing(points, slopes) {
    const frame = frameOf(HOME.theta, HOME.phi);
    const least = [Infinity, Infinity, Infinity];
    const most = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < points.length; i++) {
        least[i % 3] = Math.min(least[i % 3], points[i]);
        most[i % 3] = Math.max(most[i % 3], points[i]);
    }
    let target = /** @type {Vector} */ (least.map((low, i) => (low + most[i]) / 2));
    const middle = target;
    const seen = new Float32Array(points.length);
    for (let i = 0; i < points.length; i += 3) {
        const offset = plus(points.subarray(i, i + 3), middle, -1);
        for (let k = 0; k < 3; k++) seen[i + k] = dot(offset, frame[k]);
    }
    const shift = [0, 0];
    let distance = 0;
    for (let round = 0; round <= 8; round++) {
        distance = 0;
        for (let i = 0; i < seen.length; i += 3) {
            for (let k = 0; k < 2; k++) {
                const needed = (Math.abs(seen[i + k] - shift[k]) * MARGIN) / slopes[k] + seen[i + 2];
                distance = Math.max(distance, needed);
            }
        }
        if (round === 8) break;
        for (let k = 0; k < 2; k++) {  // centring moves what touches the edge; this settles in a few rounds
            let [low, high] = [Infinity, -Infinity];
            for (let i = 0; i < seen.length; i += 3) {
                const place = (seen[i + k] - shift[k]) / (distance - seen[i + 2]);
                low = Math.min(low, place);
                high = Math.max(high, place);
            }
            shift[k] += ((low + high) / 2) * distance;
        }
    }
    target = plus(plus(middle, frame[0], shift[0]), frame[1], shift[1]);
    return { target, distance };
}

/**
 * The tangents that `framing` wants for a picture of which only `free` is not covered by panels.
 * @param {{width: number, height: number}} picture
 * @param {Rectangle} free
 * @returns {[number, number]}
 */
export function slopesOf(picture, free) {
    const half = Math.tan((FOV / 2) * RADIANS);
    return [(half * free.width) / picture.height, (half * free.height) / picture.height];
}

/**
 * The camera turned about the framed target, which stays in the middle of what is free. To come nearer it narrows its
 * field of view, so that it never enters the shape; to go away it steps back.
 * @param {{theta: number, phi: number, zoom: number, pan: number[]}} view
 * @param {{target: Vector, distance: number}} framed
 * @param {{width: number, height: number}} picture
 * @param {Rectangle} free
 * @returns {Camera}
 */
export function placed(view, framed, picture, free) {
    const frame = frameOf(view.theta, view.phi);
    const distance = framed.distance / Math.min(view.zoom, 1);
    const half = Math.tan((FOV / 2) * RADIANS) / Math.max(view.zoom, 1);
    const pixel = (2 * distance * half) / picture.height;
    const across = free.x + free.width / 2 - picture.width / 2;
    const down = free.y + free.height / 2 - picture.height / 2;
    let target = plus(framed.target, frame[0], -across * pixel - view.pan[0] * framed.distance);
    target = plus(target, frame[1], down * pixel - view.pan[1] * framed.distance);
    return { position: plus(target, frame[2], distance), target, frame, fov: (2 * Math.atan(half)) / RADIANS };
}

/**
 * What the stages' camera reads.
 * @param {Camera} camera
 * @param {{least: ArrayLike<number>, greatest: ArrayLike<number>}} bounds
 */
export function cameraUniforms(camera, bounds) {
    let [near, far] = [Infinity, 0];
    for (let corner = 0; corner < 8; corner++) {
        const at = [0, 1, 2].map((k) => ((corner >> k) & 1 ? bounds.greatest : bounds.least)[k]);
        const depth = -dot(plus(at, camera.position, -1), camera.frame[2]);
        near = Math.min(near, depth);
        far = Math.max(far, depth);
    }
    const reach = Math.max(far * 1.001, 1e-6);
    return {
        camera_position: camera.position,
        camera_frame: camera.frame.flat(),
        camera_half: Math.tan((camera.fov / 2) * RADIANS),
        camera_parallel: false,
        camera_depths: [Math.max(near * 0.999, reach * 1e-3), reach],
    };
}

/**
 * Where a point is seen in a picture, in its pixels from the top left corner.
 * @param {Camera} camera
 * @param {ArrayLike<number>} point
 * @param {{width: number, height: number}} picture
 * @returns {[number, number]}
 */
export function projected(camera, point, picture) {
    const seen = camera.frame.map((axis) => dot(plus(point, camera.position, -1), axis));
    const scale = picture.height / 2 / Math.tan((camera.fov / 2) * RADIANS) / Math.max(-seen[2], 1e-6);
    return [picture.width / 2 + seen[0] * scale, picture.height / 2 - seen[1] * scale];
}
