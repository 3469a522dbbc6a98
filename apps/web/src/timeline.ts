// Light that changes, as src/output/web_timeline.h writes it: what each lamp gives at a time.

import { luminance } from "./blackbody";
import { asFound, hexFromColour, weightOf } from "./light_mix";
import type { Setting } from "./light_mix";
import type { Light, Rgb, Room, TimelineOfRoom } from "./room";
import type { State } from "./url_state";

export function startOf(timeline: TimelineOfRoom): number {
    return timeline.keys[0]?.time ?? 0;
}

export function endOf(timeline: TimelineOfRoom): number {
    return timeline.keys[timeline.keys.length - 1]?.time ?? 0;
}

/** Of each light, how many times its lightmap it gives; before the first key as at the first. */
export function weightsAt(timeline: TimelineOfRoom, time: number): Rgb[] {
    const { times, weights } = timeline;
    const after = Math.max(
        1,
        times.findIndex((at) => at > time),
    );
    const last = time >= endOf(timeline) ? times.length - 1 : after;
    const from = times[last - 1] ?? 0;
    const to = times[last] ?? 1;
    const share = Math.min(Math.max((time - from) / (to - from), 0), 1);
    return (weights[last - 1] ?? []).map(
        (weight, light) =>
            weight.map(
                (value, c) => value + share * ((weights[last]?.[light]?.[c] ?? value) - value),
            ) as Rgb,
    );
}

/** What a lamp is to be set to, to give so much; as near as settings have colours. */
export function settingOf(light: Light, weight: Rgb): Setting {
    const colour = light.colour.map((value, c) => value * (weight[c] ?? 0)) as Rgb;
    const share = luminance(colour) / Math.max(luminance(light.colour), 1e-9);
    const isColoured = Math.max(...weight) - Math.min(...weight) > 0.01 * Math.max(...weight);
    return { ...asFound(), share, colour: isColoured ? hexFromColour(colour) : null };
}

/** The time of the key before or after. */
export function keyBeside(timeline: TimelineOfRoom, time: number, step: 1 | -1): number {
    const beyond = timeline.keys.map((key) => key.time).filter((at) => step * (at - time) > 1e-6);
    return step > 0 ? (beyond[0] ?? startOf(timeline)) : (beyond.pop() ?? startOf(timeline));
}

/** "noon, 12": for people and for screen readers. */
export function wordsAt(timeline: TimelineOfRoom, time: number): string {
    const passed = timeline.keys.filter((key) => key.time <= time + 1e-6).pop();
    const number = String(Number(time.toFixed(1)));
    return passed?.name ? `${number}, ${passed.name}` : number;
}

/** Weights of all lights as the state has them: by the timeline where that is on. */
export function weightsOf(room: Room, state: State): Rgb[] {
    if (room.timeline && state.time !== null) return weightsAt(room.timeline, state.time);
    return room.lights.map((light, i) => weightOf(light, state.settings[i] ?? asFound()));
}

/** Brings the settings to where the timeline is, which is not beyond its ends, so that lamps go on from there. */
export function takeTime(room: Room, state: State): void {
    if (!room.timeline) state.time = null;
    if (!room.timeline || state.time === null) return;
    state.time = Math.min(Math.max(state.time, startOf(room.timeline)), endOf(room.timeline));
    const weights = weightsAt(room.timeline, state.time);
    state.settings = room.lights.map((light, i) => settingOf(light, weights[i] ?? [1, 1, 1]));
}
