// Unpacks the page's script and runs it; all else stays in the page as it came.

/** @param {string} text */
function say(text) {
    const caption = document.querySelector("#picture figcaption");
    if (caption) caption.textContent = text;
}

async function boot() {
    const packed = Uint8Array.from(atob(document.getElementById("code")?.textContent ?? ""), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    const script = document.createElement("script");
    script.textContent = await new Response(stream).text();
    document.body.append(script);
}

say("");
boot().catch(() => say("This browser is too old to turn the picture."));
