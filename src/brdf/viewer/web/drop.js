// Files of materials, dropped onto the page or chosen.

import { element } from "./element.js";
import { materialOf } from "./formats/open.js";

export class Drop {
    /** @param {import("./viewer.js").Viewer} viewer */
    constructor(viewer) {
        this.viewer = viewer;
    }

    /** @param {HTMLElement} area */
    listen(area) {
        const carriesFiles = (/** @type {DragEvent} */ event) => event.dataTransfer?.types.includes("Files");
        area.addEventListener("dragover", (event) => {
            if (!carriesFiles(event)) return;
            event.preventDefault();
            area.classList.add("dropping");
        });
        area.addEventListener("dragleave", (event) => {
            if (!area.contains(/** @type {Node} */ (event.relatedTarget))) area.classList.remove("dropping");
        });
        area.addEventListener("drop", (event) => {
            area.classList.remove("dropping");
            if (!carriesFiles(event)) return;
            event.preventDefault();
            this.open([...(/** @type {DataTransfer} */ (event.dataTransfer).files)]);
        });
    }

    choose() {
        const input = element("input", { type: "file", onchange: () => this.open([...(input.files ?? [])]) });
        input.click();
    }

    /** @param {File[]} files the first two become A and B */
    async open(files) {
        for (const [slot, file] of files.slice(0, 2).entries()) {
            try {
                this.viewer.frame.notice(`Reading ${file.name} …`);
                const source = await materialOf(file, this.viewer.payload.library);
                await this.viewer.add(source, files[1] && slot);
            } catch (error) {
                const { message } = /** @type {Error} */ (error);
                this.viewer.failed(message.includes(file.name) ? error : `${file.name} cannot be shown: ${message}`);
            }
        }
    }
}
