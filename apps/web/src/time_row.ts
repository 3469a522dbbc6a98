// The slider over time, and its button.

import { element, slider } from "./dom";
import type { TimelineOfRoom } from "./room";
import { endOf, keyBeside, startOf, wordsAt } from "./timeline";

const STEPS = 400; // of the slider
const CALM = 1500; // ms at each key, where less motion is asked for

export class TimeRow {
    readonly root: HTMLElement;
    private readonly at: { input: HTMLInputElement; set: (value: number) => void };
    private readonly button: HTMLButtonElement;
    private readonly words = element("span", { class: "help" });
    private isPlaying = false;
    private last = 0; // ms, of the step before
    private run = 0; // of Play, so that a step of one that was stopped is none of the next

    constructor(
        private readonly timeline: TimelineOfRoom,
        private readonly time: () => number | null,
        private readonly change: (time: number) => void,
    ) {
        const [min, max] = [startOf(timeline), endOf(timeline)];
        this.at = slider(
            "time",
            { min, max, step: (max - min) / STEPS },
            (value) => wordsAt(timeline, value),
            (value) => {
                this.stop();
                change(value);
            },
        );
        this.button = element("button", { type: "button" }, "Play");
        this.button.addEventListener("click", () => (this.isPlaying ? this.stop() : this.play()));
        const head = element("div", { class: "presets" }, this.button, this.words);
        this.root = element(
            "section",
            { class: "time" },
            element("h2", {}, "Time"),
            head,
            this.at.input,
        );
        this.at.set(min);
        this.show();
    }

    show(): void {
        const time = this.time();
        if (time === null) this.stop();
        else this.at.set(time);
        this.words.textContent = time === null ? this.all() : wordsAt(this.timeline, time);
    }

    private all(): string {
        const [first, last] = [startOf, endOf].map((end) =>
            wordsAt(this.timeline, end(this.timeline)),
        );
        return `${first} to ${last}`;
    }

    private stop(): void {
        this.isPlaying = false;
        ++this.run;
        this.button.textContent = "Play";
    }

    private play(): void {
        this.isPlaying = true;
        this.button.textContent = "Pause";
        const time = this.time();
        const isOver = time === null || time >= endOf(this.timeline);
        this.change(isOver ? startOf(this.timeline) : time);
        this.last = performance.now();
        this.next();
    }

    /** Evenly; from key to key where less motion is asked for. */
    private next(): void {
        const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;
        const { run } = this;
        if (isCalm) window.setTimeout(() => this.step(true, run), CALM);
        else requestAnimationFrame(() => this.step(false, run));
    }

    private step(isCalm: boolean, run: number): void {
        const time = this.time();
        if (run !== this.run || time === null) return;
        const now = performance.now();
        const end = endOf(this.timeline);
        const speed = (end - startOf(this.timeline)) / (1000 * this.timeline.seconds);
        const then = isCalm
            ? keyBeside(this.timeline, time, 1)
            : Math.min(time + speed * (now - this.last), end);
        this.last = now;
        this.change(then);
        if (then >= end) this.stop();
        else this.next();
    }
}
