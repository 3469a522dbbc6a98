// A sentence over the picture that goes by itself.

import { byId } from "./dom";

const SHOWN = 8000; // ms

let timer = 0;

export function notice(sentence: string): void {
    const place = byId("trouble");
    place.textContent = sentence;
    place.hidden = false;
    window.clearTimeout(timer);
    timer = window.setTimeout(() => (place.hidden = true), SHOWN);
}
