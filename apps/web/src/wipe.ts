// The line between two views, to be dragged or moved by arrow keys.

import { WORDS } from "./url_state";
import type { State } from "./url_state";

export class Wipe {
    constructor(
        private readonly handle: HTMLElement,
        private readonly state: () => State,
        private readonly changed: () => void,
    ) {
        handle.addEventListener("pointerdown", (event) =>
            handle.setPointerCapture(event.pointerId),
        );
        handle.addEventListener("pointermove", (event) => {
            if (!handle.hasPointerCapture(event.pointerId)) return;
            const box = handle.parentElement?.getBoundingClientRect();
            if (box) this.set((event.clientX - box.left) / box.width);
        });
        handle.addEventListener("keydown", (event) => this.key(event));
        this.show();
    }

    show(): void {
        const { show, against, wipe } = this.state();
        const stage = this.handle.parentElement;
        if (stage && against) {
            stage.dataset["left"] = WORDS[show];
            stage.dataset["right"] = WORDS[against];
        } else {
            delete stage?.dataset["right"];
        }
        this.handle.hidden = against === null;
        this.handle.style.left = `${100 * wipe}%`;
        this.handle.setAttribute("aria-valuenow", String(Math.round(100 * wipe)));
    }

    private set(share: number): void {
        this.state().wipe = Math.min(Math.max(share, 0), 1);
        this.show();
        this.changed();
    }

    private key(event: KeyboardEvent): void {
        const step = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 }[event.key];
        if (step === undefined) return;
        event.preventDefault();
        this.set(this.state().wipe + step);
    }
}
