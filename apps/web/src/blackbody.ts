// The colour of what glows, as src/relight/photometry.cpp has it.

import type { Rgb } from "./room";

export const COLDEST = 1000; // kelvin
export const HOTTEST = 40000;
const WHITE = 6504; // what a texture shows as grey

/** Rec. 709 luminance of linear RGB. */
export function luminance([r, g, b]: Rgb): number {
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

function bell(nm: number, peak: number, perNmBelow: number, perNmAbove: number): number {
    const t = (nm - peak) * (nm < peak ? perNmBelow : perNmAbove);
    return Math.exp(-0.5 * t * t);
}

/** CIE 1931 as sums of bells: Wyman, Sloan, Shirley, JCGT 2013, section 2.2. */
function colourMatching(nm: number): Rgb {
    return [
        1.056 * bell(nm, 599.8, 0.0264, 0.0323) +
            0.362 * bell(nm, 442.0, 0.0624, 0.0374) -
            0.065 * bell(nm, 501.1, 0.049, 0.0382),
        0.821 * bell(nm, 568.8, 0.0213, 0.0247) + 0.286 * bell(nm, 530.9, 0.0613, 0.0322),
        1.217 * bell(nm, 437.0, 0.0845, 0.0278) + 0.681 * bell(nm, 459.0, 0.0385, 0.0725),
    ];
}

function planck(nm: number, kelvin: number): number {
    return (nm / 560) ** -5 / Math.expm1(1.438776877e7 / (nm * kelvin));
}

function withLuminanceOne(rgb: Rgb): Rgb {
    const shown = rgb.map((value) => Math.max(value, 0)) as Rgb;
    const all = luminance(shown);
    return shown.map((value) => value / all) as Rgb;
}

/** Linear Rec. 709 of a blackbody, luminance 1. */
function blackbodyUnbalanced(kelvin: number): Rgb {
    const xyz: Rgb = [0, 0, 0];
    for (let nm = 360; nm <= 830; nm += 5) {
        const power = planck(nm, kelvin);
        colourMatching(nm).forEach((value, i) => (xyz[i] = (xyz[i] ?? 0) + power * value));
    }
    const [x, y, z] = xyz.map((value) => value / xyz[1]) as Rgb;
    return withLuminanceOne([
        3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
        -0.969266 * x + 1.8760108 * y + 0.041556 * z,
        0.0556434 * x - 0.2040259 * y + 1.0572252 * z,
    ]);
}

/** The same as the scan's camera sees it, to which 6504 K is grey. */
export function blackbodyColour(kelvin: number): Rgb {
    const white = blackbodyUnbalanced(WHITE);
    const own = blackbodyUnbalanced(Math.min(Math.max(kelvin, COLDEST), HOTTEST));
    return withLuminanceOne(own.map((value, i) => value / Math.max(white[i] ?? 1, 0.01)) as Rgb);
}
