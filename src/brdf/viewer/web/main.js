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
 * @param {string} version of what is served
 * @param {import("./viewer.js").Viewer | null} before what is shown until there is something new
 */
async function show(root, picture, version = "", before = null) {
    const bytes = await payloadBytes().catch((error) => /** @type {Error} */ (error));
    before?.destroy();
    try {
        if (bytes instanceof Error) throw bytes;
        const viewer = mount(root, bytes, { picture });
        document.title = viewer.frame.title.title;
        Object.assign(globalThis, { viewer });  // for the console: viewer.state, viewer.setState({ … })
        return viewer;
    } catch (error) {
        const served = picture.querySelector("noscript");
        if (served) {  // by the server, which has no picture of what it cannot read
            picture.querySelector("img")?.remove();
            const image = served.textContent.replace("picture", `picture?${version}`);
            if (!(bytes instanceof Error)) served.insertAdjacentHTML("afterend", image);
        }
        const caption = picture.querySelector("figcaption");
        if (caption) caption.textContent = error instanceof Error ? error.message : String(error);
        root.replaceChildren(picture);
        return null;
    }
}

function start() {
    const root = /** @type {HTMLElement} */ (document.getElementById("viewer"));
    const picture = /** @type {HTMLElement} */ (document.getElementById("picture"));
    if (document.getElementById("payload")) return void show(root, picture);
    let newest = "";
    let last = /** @type {ReturnType<typeof show>} */ (Promise.resolve(null));
    // It says its version whenever it is connected to. One after another, and none that is old by then.
    new EventSource("events").onmessage = ({ data }) => {
        if (data === newest) return;
        newest = data;
        last = last.then((viewer) => data === newest ? show(root, picture, data, viewer) : viewer);
    };
}

start();
