// One light in the panel: on or off, how bright, of which colour.

import type { Setting } from "./light_mix";
import { element, slider } from "./dom";
import type { Light, Rgb } from "./room";

const COLOURS: [string, string][] = [
    ["", "as found"],
    ["1900", "1900 K candle"],
    ["2700", "2700 K warm"],
    ["4000", "4000 K neutral"],
    ["6500", "6500 K day"],
    ["12000", "12000 K blue"],
    ["pick", "own colour"],
];

/** sRGB of a colour at its brightest, for a dot beside the name. */
export function dotColour(rgb: Rgb): string {
    const most = Math.max(...rgb, 1e-6);
    const bytes = rgb.map((value) => Math.round(255 * (value / most) ** (1 / 2.2)));
    return `rgb(${bytes.join(" ")})`;
}

export class LampRow {
    readonly root: HTMLElement;
    private readonly isOn: HTMLInputElement;
    private readonly share: { input: HTMLInputElement; set: (value: number) => void };
    private readonly colour: HTMLSelectElement;
    private readonly picked: HTMLInputElement;
    private lastShare = 1; // to which it comes on again

    constructor(
        light: Light,
        private readonly setting: () => Setting,
        private readonly change: (setting: Setting) => void,
    ) {
        this.isOn = element("input", { type: "checkbox", role: "switch" });
        this.isOn.addEventListener("change", () => this.toggle());
        const dot = element("span", { class: "dot", "aria-hidden": true });
        dot.style.background = dotColour(light.colour);
        const label = element("label", { class: "name" }, this.isOn, dot, light.name);
        this.share = slider(
            `brightness of ${light.name}`,
            { min: 0, max: 2, step: 0.01 },
            (value) => `${Math.round(100 * value)} per cent`,
            (share) => this.change({ ...this.setting(), share }),
        );
        this.colour = element("select", { "aria-label": `colour of ${light.name}` });
        for (const [value, text] of COLOURS) this.colour.append(element("option", { value }, text));
        this.picked = element("input", {
            type: "color",
            "aria-label": `own colour of ${light.name}`,
            value: "#ffb070",
        });
        this.colour.addEventListener("change", () => this.recolour());
        this.picked.addEventListener("input", () => this.recolour());
        const head = element("div", { class: "head" }, label, this.colour, this.picked);
        this.root = element("li", { class: "lamp" }, head, this.share.input);
        this.show();
    }

    toggle(): void {
        const setting = this.setting();
        if (setting.share > 0) this.lastShare = setting.share;
        this.change({ ...setting, share: setting.share > 0 ? 0 : this.lastShare });
    }

    /** Brings the controls to what is set. */
    show(): void {
        const { share, kelvin, colour } = this.setting();
        this.isOn.checked = share > 0;
        this.share.set(share);
        this.picked.hidden = colour === null;
        if (colour) this.picked.value = colour;
        const value = colour ? "pick" : kelvin === null ? "" : String(Math.round(kelvin));
        if (![...this.colour.options].some((option) => option.value === value))
            this.colour.append(element("option", { value }, `${value} K`));
        this.colour.value = value;
    }

    private recolour(): void {
        const { value } = this.colour;
        const setting = {
            ...this.setting(),
            kelvin: null as number | null,
            colour: null as string | null,
        };
        if (value === "pick") setting.colour = this.picked.value;
        else if (value) setting.kelvin = Number(value);
        this.change(setting);
    }
}
