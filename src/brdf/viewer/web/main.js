// The page: shows what Python handed over, and again when it is served and changes.

import { mount } from "./viewer.js";

/**
 * The container of bytes, which lies in the page or beside it.
 * @returns {Promise<ArrayBuffer>}
 */
async function payloadBytes() {
    const embedded = document.getElementById("payload");
    if (embedded) {
        const packed = Uint8Array.from(atob(embedded.textContent ?? ""), (c) => c.charCodeAt(0));
        const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
        return new Response(stream).arrayBuffer();
    }
    const answer = await fetch("payload");
    if (!answer.ok) throw new Error(await answer.text());
    return answer.arrayBuffer();
}

/**
 * @param {HTMLElement} root
 * @param {HTMLElement} picture what stands there until the first frame, and where there can be none
 */
async function show(root, picture) {
    try {
        const viewer = mount(root, await payloadBytes(), { picture });
        Object.assign(globalThis, { viewer });  // for the console: viewer.state, viewer.setState({ … })
        return viewer;
    } catch (error) {
        const image = picture.querySelector("img");
        if (image?.dataset.src) image.src = image.dataset.src;  // from the server only where it is needed
        const caption = picture.querySelector("figcaption");
        if (caption) caption.textContent = error instanceof Error ? error.message : String(error);
        root.replaceChildren(picture);
        return null;
    }
}

async function start() {
    const root = /** @type {HTMLElement} */ (document.getElementById("viewer"));
    const picture = /** @type {HTMLElement} */ (document.getElementById("picture"));
    let viewer = await show(root, picture);
    if (document.getElementById("payload")) return;
    new EventSource("events").addEventListener("changed", async () => {
        viewer?.destroy();
        viewer = await show(root, picture);
    });
}

start();
