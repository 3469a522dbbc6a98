// One model in the panel.

import * as THREE from "three";

import { element, slider } from "./dom";
import type { Model } from "./dropped_models";
import type { Rgb } from "./room";

export interface ModelRowActions {
    box: { low: Rgb; high: Rgb }; // of the room
    changed(): void;
    remove(): void;
}

interface Line {
    word: string;
    label: string; // with the model's name behind it
    range: { min: number; max: number; step: number };
    unit: string;
    now: number;
    change: (value: number) => void;
}

function linesOf(
    { root: { position, rotation } }: Model,
    { low, high }: ModelRowActions["box"],
): Line[] {
    const along = (axis: "x" | "z", i: 0 | 2): Line => ({
        word: `along ${axis}`,
        label: `move along ${axis}`,
        range: { min: low[i], max: high[i], step: 0.05 },
        unit: "metres",
        now: position[axis],
        change: (value) => (position[axis] = value),
    });
    const turn = {
        word: "turn",
        label: "turn",
        range: { min: -180, max: 180, step: 5 },
        unit: "degrees",
        now: THREE.MathUtils.radToDeg(rotation.y),
        change: (value: number) => (rotation.y = THREE.MathUtils.degToRad(value)),
    };
    return [turn, along("x", 0), along("z", 2)];
}

export function modelRow(model: Model, actions: ModelRowActions): HTMLElement {
    const remove = element(
        "button",
        { type: "button", "aria-label": `remove ${model.name}` },
        "Remove",
    );
    remove.addEventListener("click", () => actions.remove());
    const name = element("span", { class: "name" }, model.name);
    const lines = linesOf(model, actions.box).map(({ word, label, range, unit, now, change }) => {
        const made = slider(
            `${label} ${model.name}`,
            range,
            (value) => `${Number(value.toFixed(2))} ${unit}`,
            (value) => {
                change(value);
                actions.changed();
            },
        );
        made.set(now);
        return element("label", { class: "line" }, element("span", {}, word), made.input);
    });
    return element(
        "li",
        { class: "lamp" },
        element("div", { class: "head" }, name, remove),
        ...lines,
    );
}
