// One added lamp in the panel.

import type { AddedLamp } from "./added_lamp";
import { LEAST_LUMENS, MOST_LUMENS } from "./added_lamp";
import { blackbodyColour } from "./blackbody";
import { element, slider } from "./dom";
import { dotColour } from "./lamp_row";
import type { Rgb } from "./room";

export interface AddedRowActions {
    lamp(): AddedLamp | undefined;
    box: { low: Rgb; high: Rgb }; // of the room
    changed(): void;
    remove(): void;
}

interface Slider {
    input: HTMLInputElement;
    set: (value: number) => void;
}

const DOUBLINGS = Math.log2(MOST_LUMENS / LEAST_LUMENS);

export class AddedRow {
    readonly root: HTMLElement;
    private readonly isOn = element("input", { type: "checkbox", role: "switch" });
    private readonly dot = element("span", { class: "dot", "aria-hidden": true });
    private readonly lumens: Slider;
    private readonly kelvin: Slider;
    private readonly height: Slider;

    constructor(
        i: number,
        private readonly actions: AddedRowActions,
    ) {
        const name = `new lamp ${i + 1}`;
        const { low, high } = actions.box;
        this.isOn.addEventListener("change", () =>
            this.set((lamp) => (lamp.isOn = this.isOn.checked)),
        );
        this.lumens = slider(
            `brightness of ${name}`,
            { min: 0, max: DOUBLINGS, step: 0.05 },
            (value) => `${lumensOf(value)} lumens`,
            (value) =>
                this.set((lamp) => {
                    lamp.lumens = lumensOf(value);
                    lamp.isOn = true;
                }),
        );
        this.kelvin = slider(
            `colour temperature of ${name}`,
            { min: 1800, max: 12000, step: 100 },
            (value) => `${value} kelvin`,
            (value) => this.set((lamp) => (lamp.kelvin = value)),
        );
        this.height = slider(
            `height of ${name}`,
            { min: low[1], max: high[1], step: 0.01 },
            (value) => `${(value - low[1]).toFixed(2)} metres`,
            (value) => this.set((lamp) => (lamp.position[1] = value)),
        );
        const remove = element(
            "button",
            { type: "button", "aria-label": `remove ${name}` },
            "Remove",
        );
        remove.addEventListener("click", () => actions.remove());
        const label = element("label", { class: "name" }, this.isOn, this.dot, name);
        const line = (word: string, { input }: Slider) =>
            element("label", { class: "line" }, element("span", {}, word), input);
        this.root = element(
            "li",
            { class: "lamp" },
            element("div", { class: "head" }, label, remove),
            line("brightness", this.lumens),
            line("colour", this.kelvin),
            line("height", this.height),
        );
        this.show();
    }

    show(): void {
        const lamp = this.actions.lamp();
        if (!lamp) return;
        this.isOn.checked = lamp.isOn;
        this.dot.style.background = dotColour(blackbodyColour(lamp.kelvin));
        this.lumens.set(Math.log2(lamp.lumens / LEAST_LUMENS));
        this.kelvin.set(lamp.kelvin);
        this.height.set(lamp.position[1]);
    }

    private set(change: (lamp: AddedLamp) => void): void {
        const lamp = this.actions.lamp();
        if (!lamp) return;
        change(lamp);
        this.actions.changed();
    }
}

function lumensOf(doublings: number): number {
    return Math.round(LEAST_LUMENS * 2 ** doublings);
}
