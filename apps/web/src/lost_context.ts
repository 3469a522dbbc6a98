// Phones take the graphics memory of a page in the background away. What is shown is in the address,
// so the page loads anew as soon as it may draw again; models that were dropped onto it are gone.

import { trouble } from "./notice";

const SOON = 10_000; // ms after loading: what is lost so soon would be lost again

/** `keep` brings the address up to date. */
export function loadAnewAfterLoss(canvas: HTMLCanvasElement, keep: () => void): void {
    canvas.addEventListener("webglcontextlost", (event) => {
        event.preventDefault(); // else it is lost for good
        keep();
        trouble("The graphics memory was taken away from this page; it waits to get it back.");
    });
    canvas.addEventListener("webglcontextrestored", () => {
        if (performance.now() > SOON) location.reload();
        else trouble("This device has too little graphics memory for this room.");
    });
}
