// What hands and keys do, for those who ask.

import { element, iconButton } from "./element.js";

const TITLE = "Hands and keys";

const HANDS = [
    ["Drag", "turn the object"],
    ["Shift and drag, or drag a ring", "move the light; without one, turn the surroundings"],
    ["Wheel, pinch", "nearer, farther"],
    ["Right button, Ctrl and drag, two fingers", "shift"],
    ["Double click", "back to the start"],
    ["Drop a file", "show a .binary, .bsdf or .safetensors"],
];

const KEYS = [
    ["← → ↑ ↓", "turn"],
    ["Shift and ← → ↑ ↓", "move the light"],
    ["+  −  0", "nearer, farther, back to the start"],
    ["1 … 5", "A, B, split, side by side, difference"],
    ["g", "next shape"],
    ["[  ]", "darker, brighter"],
    ["l  p  d", "light by dragging, panel, dark or light"],
    ["o  s  ?", "open a file, save a PNG, this help"],
];

/** For those who cannot see the picture. */
export const KEYS_TEXT =
    "Arrow keys turn the object, with Shift the light; plus and minus zoom; ? opens the help.";

/** @returns {HTMLDialogElement} */
export function helpDialog() {
    const list = (/** @type {string[][]} */ rows) =>
        element("dl", {}, ...rows.flatMap(([what, does]) => [element("dt", {}, what), element("dd", {}, does)]));
    /** @type {HTMLDialogElement} */
    const dialog = element("dialog", {
        class: "help", "aria-label": TITLE,
        onclick: (/** @type {MouseEvent} */ event) => event.target === dialog && dialog.close(),
    },
        element("div", { class: "sheet" },
            element("header", {}, element("h2", {}, TITLE), iconButton("close", "Close", () => dialog.close())),
            element("h3", {}, "Mouse and touch"), list(HANDS),
            element("h3", {}, "Keys, on the picture"), list(KEYS)));
    return dialog;
}
