// The line between two materials in one picture, to drag.

import { element } from "./element.js";

/**
 * @param {(share: number) => void} move where it is, as a share of the width
 * @returns {{element: HTMLElement, refresh: (shown: boolean, share: number, low: number, high: number) => void}} `low`
 *     and `high`: how far it may be dragged
 */
export function divider(move) {
    let [low, high] = [0, 1];
    let now = 0.5;
    const to = (/** @type {number} */ share) => move(Math.min(high, Math.max(low, share)));
    const line = element("div", {
        class: "divider", role: "slider", tabindex: 0, "aria-label": "Divider between A and B", "aria-valuemin": 0,
        "aria-valuemax": 100, "aria-orientation": "horizontal",
        onpointerdown: (/** @type {PointerEvent} */ event) => line.setPointerCapture(event.pointerId),
        onpointermove: (/** @type {PointerEvent} */ event) => {
            if (!line.hasPointerCapture(event.pointerId)) return;
            const box = /** @type {HTMLElement} */ (line.parentElement).getBoundingClientRect();
            to((event.clientX - box.left) / box.width);
        },
        onkeydown: (/** @type {KeyboardEvent} */ event) => {
            const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
            if (!step) return;
            event.preventDefault();
            to(now + step);
        },
    }, element("span", { class: "grip" }));
    return {
        element: line,
        refresh: (shown, share, least, most) => {
            [low, high, now] = [least, most, share];
            line.hidden = !shown;
            line.style.left = `${share * 100}%`;
            line.setAttribute("aria-valuenow", String(Math.round(share * 100)));
        },
    };
}
