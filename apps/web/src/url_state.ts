// What a person sees, in the part of the address behind #, so that a link shows it to another.

import { lampsFrom, wordsOfLamps } from "./added_lamp";
import type { AddedLamp } from "./added_lamp";
import { asFound } from "./light_mix";
import type { Setting } from "./light_mix";

export type Show = "scan" | "albedo" | "relit";
export const SHOWS: Show[] = ["scan", "albedo", "relit"];
export const WORDS: Record<Show, string> = { scan: "As scanned", albedo: "Albedo", relit: "Relit" };

export interface Pose {
    position: [number, number, number]; // m
    yaw: number; // rad; 0 looks along -z, more turns to the left
    pitch: number; // rad; more looks up
}

export interface State {
    show: Show;
    against: Show | null; // to the right of the wipe
    wipe: number; // share of the width
    isMetered: boolean; // exposed by what is seen; else as the room as it was scanned
    stops: number; // more than that
    settings: Setting[]; // a light each
    time: number | null; // of the timeline, which then has the lights; null: they are as set
    added: AddedLamp[]; // lamps that a visitor put up
    pose: Pose | null; // null: where the page begins
    hasPanel: boolean;
}

export function initialState(lights: number): State {
    return {
        show: "relit",
        against: null,
        wipe: 0.5,
        isMetered: false,
        stops: 0,
        settings: Array.from({ length: lights }, asFound),
        time: null,
        added: [],
        pose: null,
        hasPanel: true,
    };
}

const short = (value: number) => String(Number(value.toFixed(3)));

function wordOf(setting: Setting): string {
    const words = [short(setting.share)];
    if (setting.colour) words.push(setting.colour.slice(1));
    else if (setting.kelvin !== null) words.push(`${Math.round(setting.kelvin)}K`);
    return words.join(",");
}

/** Nothing of what is as it is at first. */
export function hashOf(state: State): string {
    const words: string[] = [];
    if (state.show !== "relit") words.push(`show=${state.show}`);
    if (state.against) words.push(`against=${state.against}`, `wipe=${short(state.wipe)}`);
    if (state.isMetered) words.push("exposure=auto");
    if (state.stops !== 0) words.push(`stops=${short(state.stops)}`);
    state.settings.forEach((setting, i) => {
        const word = wordOf(setting);
        if (word !== "1" && state.time === null) words.push(`light${i}=${word}`);
    });
    if (state.time !== null) words.push(`time=${short(state.time)}`);
    words.push(...wordsOfLamps(state.added));
    if (state.pose) {
        const { position, yaw, pitch } = state.pose;
        words.push(`at=${[...position, yaw, pitch].map(short).join(",")}`);
    }
    if (!state.hasPanel) words.push("panel=off");
    return words.join("&");
}

function numberIn(text: string | undefined, low: number, high: number): number | null {
    if (text === undefined || text.trim() === "") return null;
    const value = Number(text);
    return Number.isFinite(value) ? Math.min(Math.max(value, low), high) : null;
}

function settingFrom(word: string): Setting {
    const [share, colour = ""] = word.split(",");
    const setting = asFound();
    setting.share = numberIn(share, 0, 4) ?? 1;
    if (/^[0-9a-f]{6}$/i.test(colour)) setting.colour = `#${colour.toLowerCase()}`;
    else if (colour.endsWith("K")) setting.kelvin = numberIn(colour.slice(0, -1), 1000, 40000);
    return setting;
}

/** What means nothing is passed over: a link may be of another page. */
export function stateFrom(hash: string, lights: number): State {
    const state = initialState(lights);
    const words = new URLSearchParams(hash.replace(/^#/, ""));
    const showIn = (word: string | null) => SHOWS.find((show) => show === word) ?? null;
    state.show = showIn(words.get("show")) ?? state.show;
    state.against = showIn(words.get("against"));
    state.wipe = numberIn(words.get("wipe") ?? undefined, 0, 1) ?? state.wipe;
    state.isMetered = words.get("exposure") === "auto";
    state.stops = numberIn(words.get("stops") ?? undefined, -10, 10) ?? 0;
    state.settings = state.settings.map((setting, i) => {
        const word = words.get(`light${i}`);
        return word === null ? setting : settingFrom(word);
    });
    state.time = numberIn(words.get("time") ?? undefined, -1e9, 1e9);
    state.added = lampsFrom(words);
    const at = (words.get("at") ?? "").split(",").map((text) => numberIn(text, -1e5, 1e5));
    const [x, y, z, yaw, pitch] = at;
    if (x != null && y != null && z != null && yaw != null && pitch != null)
        state.pose = { position: [x, y, z], yaw, pitch };
    state.hasPanel = words.get("panel") !== "off";
    return state;
}
