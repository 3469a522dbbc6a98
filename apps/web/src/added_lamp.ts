// Lamps that a visitor puts up: balls that shine alike all around.

import { blackbodyColour } from "./blackbody";
import { COLDEST, HOTTEST } from "./blackbody";
import type { Rgb } from "./room";

export const MOST_LAMPS = 4;
export const LAMP_RADIUS = 0.06; // m
export const LEAST_LUMENS = 25;
export const MOST_LUMENS = 25600;
const NITS_OF_WHITE = 100; // as relamp relight has it where nobody says another

export interface AddedLamp {
    position: Rgb; // m
    lumens: number;
    kelvin: number;
    isOn: boolean;
}

/** Radiant intensity, radiance m^2: intensityFromLumens of src/relight/photometry.h. */
export function intensityOf(lamp: AddedLamp): Rgb {
    if (!lamp.isOn) return [0, 0, 0];
    const all = lamp.lumens / (4 * Math.PI) / NITS_OF_WHITE;
    return blackbodyColour(lamp.kelvin).map((value) => all * value) as Rgb;
}

/** Of its surface. */
export function radianceOf(lamp: AddedLamp): Rgb {
    const across = Math.PI * LAMP_RADIUS * LAMP_RADIUS;
    return intensityOf(lamp).map((value) => value / across) as Rgb;
}

/**
 * What makes grey paper 1.5 m away as bright as the middle of the picture, one of 25, 50, 100 ...
 * lumens: a scan does not tell how bright its room was.
 */
export function lumensFor(stops: number): number {
    const grey = 0.18 / 2 ** stops; // radiance
    const intensity = (grey * Math.PI * 1.5 * 1.5) / 0.5;
    const lumens = intensity * 4 * Math.PI * NITS_OF_WHITE;
    const step = Math.round(Math.log2(lumens / LEAST_LUMENS));
    return Math.min(Math.max(LEAST_LUMENS * 2 ** step, LEAST_LUMENS), MOST_LUMENS);
}

const short = (value: number) => String(Number(value.toFixed(3)));

/** `lamp0=x,y,z,800,2700K`, and `off` behind that. */
export function wordsOfLamps(lamps: AddedLamp[]): string[] {
    return lamps.map(({ position, lumens, kelvin, isOn }, i) => {
        const parts = [...position.map(short), short(lumens), `${Math.round(kelvin)}K`];
        return `lamp${i}=${parts.join(",")}${isOn ? "" : ",off"}`;
    });
}

function lampFrom(word: string): AddedLamp | null {
    const match = /^([^,]+),([^,]+),([^,]+),([^,]+),([^,K]+)K(,off)?$/.exec(word);
    if (!match) return null;
    const [x, y, z, lumens, kelvin] = match.slice(1, 6).map(Number);
    if (x === undefined || y === undefined || z === undefined) return null;
    if (lumens === undefined || kelvin === undefined) return null;
    if (![x, y, z].every((value) => Math.abs(value) < 1e5)) return null;
    if (!(lumens >= 0) || !(kelvin > 0)) return null;
    return {
        position: [x, y, z],
        lumens: Math.min(Math.max(lumens, LEAST_LUMENS), MOST_LUMENS),
        kelvin: Math.min(Math.max(kelvin, COLDEST), HOTTEST),
        isOn: match[6] === undefined,
    };
}

export function lampsFrom(words: URLSearchParams): AddedLamp[] {
    const lamps: AddedLamp[] = [];
    for (let i = 0; i < MOST_LAMPS; ++i) {
        const lamp = lampFrom(words.get(`lamp${i}`) ?? "");
        if (lamp) lamps.push(lamp);
    }
    return lamps;
}
