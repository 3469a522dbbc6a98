// Sentences over the picture.

import { byId } from "./dom";

const SHOWN = 8000; // ms

let timer = 0;

/** Stays. */
export function trouble(sentence: string): void {
    const place = byId("trouble");
    place.textContent = sentence;
    place.hidden = false;
    window.clearTimeout(timer);
}

/** Goes by itself. */
export function notice(sentence: string): void {
    trouble(sentence);
    timer = window.setTimeout(() => (byId("trouble").hidden = true), SHOWN);
}
