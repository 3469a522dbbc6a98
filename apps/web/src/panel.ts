// The panel: what is shown, the lights by name, presets, exposure, how one moves.

import { byId, element, slider } from "./dom";
import { LampRow } from "./lamp_row";
import { presetsFor } from "./light_mix";
import type { Room } from "./room";
import type { Way } from "./steering";
import { TimeRow } from "./time_row";
import { takeTime } from "./timeline";
import { SHOWS, WORDS } from "./url_state";
import type { Show, State } from "./url_state";

export interface PanelActions {
    state(): State;
    changed(isLight: boolean): void; // after the state was changed
    setWay(way: Way): void;
    goHome(): void;
}

export class Panel {
    private readonly rows: LampRow[];
    private readonly time: TimeRow | null;
    private readonly shows: HTMLInputElement[] = [];
    private readonly against: HTMLSelectElement;
    private readonly isMetered = element("input", { type: "checkbox", role: "switch" });
    private readonly stops: { input: HTMLInputElement; set: (value: number) => void };

    constructor(
        room: Room,
        private readonly hasScan: boolean,
        private readonly actions: PanelActions,
    ) {
        const { state, changed } = actions;
        this.rows = room.lights.map(
            (light, i) =>
                new LampRow(
                    light,
                    () => state().settings[i]!,
                    (setting) => {
                        state().settings[i] = setting;
                        this.lightChanged();
                    },
                ),
        );
        this.against = element("select", { "aria-label": "compare with" });
        this.against.append(element("option", { value: "" }, "nothing"));
        for (const show of this.possible())
            this.against.append(element("option", { value: show }, WORDS[show]));
        this.against.addEventListener("change", () => {
            state().against = SHOWS.find((show) => show === this.against.value) ?? null;
            changed(false);
        });
        this.stops = slider(
            "exposure",
            { min: -6, max: 6, step: 0.1 },
            (value) => `${value.toFixed(1)} stops`,
            (value) => {
                state().stops = value;
                changed(false);
            },
        );
        this.time = this.timeRow(room);
        byId("panel").append(
            this.views(),
            this.presets(room),
            ...(this.time ? [this.time.root] : []),
            this.lights(),
            element("section", { id: "added" }),
            element("section", { id: "models" }),
            this.exposure(),
            this.moving(),
        );
        this.show();
    }

    toggle(light: number): void {
        this.rows[light]?.toggle();
    }

    show(): void {
        const state = this.actions.state();
        for (const input of this.shows) input.checked = input.value === state.show;
        this.against.value = state.against ?? "";
        this.isMetered.checked = state.isMetered;
        this.stops.set(state.stops);
        for (const row of this.rows) row.show();
        this.time?.show();
    }

    private possible(): Show[] {
        return SHOWS.filter((show) => show !== "scan" || this.hasScan);
    }

    /** Shows the room relit, as a change of its light wants it. */
    relit(): void {
        const state = this.actions.state();
        if (state.show !== "relit" && state.against !== "relit") state.show = "relit";
        this.show();
    }

    private lightChanged(time: number | null = null): void {
        this.actions.state().time = time;
        this.relit();
        this.actions.changed(true);
    }

    private views(): HTMLElement {
        const group = element("fieldset", { class: "views" }, element("legend", {}, "Show"));
        for (const show of this.possible()) {
            const input = element("input", { type: "radio", name: "show", value: show });
            input.addEventListener("change", () => {
                this.actions.state().show = show;
                this.actions.changed(false);
            });
            this.shows.push(input);
            group.append(element("label", {}, input, element("span", {}, WORDS[show])));
        }
        const compare = element("label", { class: "against" }, "compare with ", this.against);
        return element("section", {}, group, compare);
    }

    private presets(room: Room): HTMLElement {
        const group = element("div", { class: "presets", role: "group", "aria-label": "presets" });
        for (const preset of presetsFor(room.lights)) {
            const button = element("button", { type: "button" }, preset.name);
            button.addEventListener("click", () => {
                this.actions.state().settings = room.lights.map(preset.settings);
                this.lightChanged();
            });
            group.append(button);
        }
        return element("section", {}, element("h2", {}, "Light"), group);
    }

    private timeRow(room: Room): TimeRow | null {
        const { state } = this.actions;
        if (!room.timeline) return null;
        return new TimeRow(
            room.timeline,
            () => state().time,
            (time) => {
                state().time = time;
                takeTime(room, state());
                this.lightChanged(time);
            },
        );
    }

    private lights(): HTMLElement {
        const rows = this.rows.map((row) => row.root);
        return element(
            "section",
            {},
            element("h2", {}, "Lights of the room"),
            element("ul", { class: "lamps", "aria-label": "lights" }, ...rows),
        );
    }

    private exposure(): HTMLElement {
        this.isMetered.addEventListener("change", () => {
            this.actions.state().isMetered = this.isMetered.checked;
            this.actions.changed(false);
        });
        const metered = element("label", { class: "name" }, this.isMetered, "automatic");
        metered.title = "So that what is seen is neither dark nor glaring";
        return element(
            "section",
            { class: "exposure" },
            element("h2", {}, "Exposure"),
            metered,
            this.stops.input,
        );
    }

    private moving(): HTMLElement {
        const way = element("button", { type: "button", "aria-pressed": false }, "Orbit");
        way.addEventListener("click", () => {
            const isOrbit = way.getAttribute("aria-pressed") !== "true";
            way.setAttribute("aria-pressed", String(isOrbit));
            this.actions.setWay(isOrbit ? "orbit" : "walk");
        });
        const home = element("button", { type: "button" }, "Back to the start");
        home.addEventListener("click", () => this.actions.goHome());
        const help = element(
            "p",
            { class: "help" },
            "Drag to look; scroll, pinch or W A S D to walk, Q E down and up; click a lamp to switch it.",
        );
        return element(
            "section",
            {},
            element("h2", {}, "Move"),
            element("div", { class: "presets" }, way, home),
            help,
        );
    }
}
