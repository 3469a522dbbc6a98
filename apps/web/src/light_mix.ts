// What each light is set to, and what that makes of its lightmap.

import { blackbodyColour, luminance } from "./blackbody";
import type { Light, Rgb } from "./room";

export interface Setting {
    share: number; // of how bright it was found; 0: off
    kelvin: number | null; // null: the colour that it was found in
    colour: string | null; // "#rrggbb" in place of both; null: none
}

export function asFound(): Setting {
    return { share: 1, kelvin: null, colour: null };
}

function linearFromByte(byte: number): number {
    const value = byte / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
}

/** The colour at its brightest, "#rrggbb". */
export function hexFromColour(rgb: Rgb): string {
    const most = Math.max(...rgb, 1e-9);
    const byte = (value: number) => {
        const srgb = value <= 0.0031308 ? 12.92 * value : 1.055 * value ** (1 / 2.4) - 0.055;
        return Math.round(255 * srgb)
            .toString(16)
            .padStart(2, "0");
    };
    return `#${rgb.map((value) => byte(Math.max(value, 0) / most)).join("")}`;
}

/** Linear, of luminance 1; grey for black. */
export function colourFromHex(hex: string): Rgb {
    const rgb = [1, 3, 5].map((at) => linearFromByte(parseInt(hex.slice(at, at + 2), 16))) as Rgb;
    const all = luminance(rgb);
    return all > 0 ? (rgb.map((value) => value / all) as Rgb) : [1, 1, 1];
}

/**
 * How many times its lightmap a light gives, a channel each: light of one colour stays in its
 * channel, however often it bounces. What was not found in a channel cannot be made more.
 */
export function weightOf(light: Light, setting: Setting): Rgb {
    const wanted = setting.colour
        ? colourFromHex(setting.colour)
        : setting.kelvin === null
          ? null
          : blackbodyColour(setting.kelvin);
    if (!wanted) return [setting.share, setting.share, setting.share];
    const found = luminance(light.colour);
    return light.colour.map((value, i) =>
        value > 0 ? (setting.share * found * (wanted[i] ?? 1)) / value : setting.share,
    ) as Rgb;
}

export interface Preset {
    name: string;
    settings: (light: Light) => Setting;
}

/** Those that make a difference in this room. */
export function presetsFor(lights: Light[]): Preset[] {
    const isLamp = (light: Light) => light.kind === "lamp";
    const only = (wanted: (light: Light) => boolean) => (light: Light) => ({
        ...asFound(),
        share: wanted(light) ? 1 : 0,
    });
    const presets: Preset[] = [{ name: "As found", settings: asFound }];
    if (lights.some(isLamp) && !lights.every(isLamp)) {
        presets.push({ name: "Night", settings: only(isLamp) });
        presets.push({ name: "Day", settings: only((light) => !isLamp(light)) });
    }
    if (lights.some(isLamp))
        presets.push({
            name: "Evening",
            settings: (light) =>
                isLamp(light)
                    ? { share: 0.7, kelvin: 2700, colour: null }
                    : { share: 0.03, kelvin: 12000, colour: null },
        });
    return presets;
}
