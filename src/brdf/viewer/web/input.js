// Mouse, touch and keys on the picture.

/**
 * What the hands may do. Distances in pixels of the page; `place` within the canvas.
 * @typedef {{
 *     orbit: (x: number, y: number) => void, pan: (x: number, y: number) => void, zoom: (factor: number) => void,
 *     light: (place: [number, number], x: number) => void, nudgeLight: (x: number, y: number) => void,
 *     lighting: () => boolean, home: () => void, key: (key: string) => boolean, embedded: boolean}} Hands
 */

const STEP = 12;  // pixels that an arrow key stands for

/**
 * @param {HTMLElement} canvas
 * @param {Hands} hands
 * @param {AbortSignal} signal ends it
 */
export function listen(canvas, hands, signal) {
    /** @type {Map<number, [number, number]>} */
    const pointers = new Map();
    let lighting = false;
    const place = (/** @type {PointerEvent} */ event) => {
        const box = canvas.getBoundingClientRect();
        return /** @type {[number, number]} */ ([event.clientX - box.left, event.clientY - box.top]);
    };
    const on = (/** @type {string} */ name, /** @type {(event: any) => void} */ act) =>
        canvas.addEventListener(name, act, { signal, passive: false });

    on("pointerdown", (/** @type {PointerEvent} */ event) => {
        canvas.focus({ preventScroll: true });
        canvas.setPointerCapture(event.pointerId);
        pointers.set(event.pointerId, place(event));
        lighting = pointers.size === 1 && event.button === 0 && (event.shiftKey || hands.lighting());
        if (lighting) hands.light(place(event), 0);
    });
    on("pointermove", (/** @type {PointerEvent} */ event) => {
        const before = pointers.get(event.pointerId);
        if (!before) return;
        const now = place(event);
        const [x, y] = [now[0] - before[0], now[1] - before[1]];
        if (pointers.size === 2) {
            const other = /** @type {[number, number]} */ ([...pointers].find(([id]) => id !== event.pointerId)?.[1]);
            const apart = (/** @type {[number, number]} */ p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
            hands.zoom(apart(now) / apart(before));
            hands.pan(x / 2, y / 2);
        } else if (lighting) {
            hands.light(now, x);
        } else if (event.buttons & 6 || event.ctrlKey || event.metaKey) {
            hands.pan(x, y);
        } else {
            hands.orbit(x, y);
        }
        pointers.set(event.pointerId, now);
    });
    const up = (/** @type {PointerEvent} */ event) => {
        pointers.delete(event.pointerId);
        lighting = false;
    };
    on("pointerup", up);
    on("pointercancel", up);
    on("wheel", (/** @type {WheelEvent} */ event) => {
        if (hands.embedded && document.activeElement !== canvas) return;  // the page around it scrolls
        event.preventDefault();
        const lines = event.deltaMode === 1 ? 24 : 1;
        hands.zoom(Math.exp(-Math.max(-200, Math.min(200, event.deltaY * lines)) * (event.ctrlKey ? 0.01 : 0.0015)));
    });
    on("dblclick", () => hands.home());
    on("contextmenu", (/** @type {Event} */ event) => event.preventDefault());
    const press = (/** @type {KeyboardEvent} */ event) => {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        const arrows = { ArrowLeft: [-STEP, 0], ArrowRight: [STEP, 0], ArrowUp: [0, -STEP], ArrowDown: [0, STEP] };
        const arrow = arrows[/** @type {keyof typeof arrows} */ (event.key)];
        if (arrow && event.shiftKey) hands.nudgeLight(arrow[0], arrow[1]);
        else if (arrow) hands.orbit(arrow[0], arrow[1]);
        else if (event.key === "+" || event.key === "=") hands.zoom(1.1);
        else if (event.key === "-" || event.key === "_") hands.zoom(1 / 1.1);
        else if (event.key === "Home" || event.key === "0") hands.home();
        else if (!hands.key(event.key)) return;
        event.preventDefault();
    };
    on("keydown", press);
    if (hands.embedded) return;  // a page of its own has keys even where nothing has the focus
    document.addEventListener("keydown", (event) => event.target === document.body && press(event), { signal });
}
