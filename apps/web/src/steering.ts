// Mouse, touch and keys move the visitor.

import * as THREE from "three";

import { orbited, turned, walked } from "./camera";
import type { Pose } from "./url_state";

const TURN = 0.004; // rad a pixel
const STEP = 1.5; // m a second
const TAP = 16; // ms that a press of a key lasts at least
const SLOP = 5; // pixels that a click may move

export type Way = "walk" | "orbit";

export interface Steered {
    pose(): Pose;
    move(pose: Pose): void;
    click(x: number, y: number): void; // CSS pixels of the canvas
}

const KEYS: Record<string, [number, number, number]> = {
    KeyW: [0, 0, 1],
    ArrowUp: [0, 0, 1],
    KeyS: [0, 0, -1],
    ArrowDown: [0, 0, -1],
    KeyA: [-1, 0, 0],
    KeyD: [1, 0, 0],
    KeyE: [0, 1, 0],
    KeyQ: [0, -1, 0],
};
const TURNS: Record<string, number> = { ArrowLeft: 1, ArrowRight: -1 };

interface Finger {
    x: number;
    y: number;
}

export class Steering {
    way: Way = "walk";
    private readonly fingers = new Map<number, Finger>();
    private readonly keys = new Set<string>();
    private moved = 0;
    private last = 0;

    constructor(
        private readonly canvas: HTMLElement,
        private readonly centre: THREE.Vector3,
        private readonly steered: Steered,
    ) {
        canvas.addEventListener("pointerdown", (event) => this.down(event));
        canvas.addEventListener("pointermove", (event) => this.drag(event));
        canvas.addEventListener("pointerup", (event) => this.up(event));
        canvas.addEventListener("pointercancel", (event) => this.fingers.delete(event.pointerId));
        canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
        canvas.addEventListener("keydown", (event) => this.key(event));
        canvas.addEventListener("keyup", (event) => this.keys.delete(event.code));
        canvas.addEventListener("blur", () => this.keys.clear());
    }

    private down(event: PointerEvent): void {
        this.canvas.setPointerCapture(event.pointerId);
        this.fingers.set(event.pointerId, { x: event.clientX, y: event.clientY });
        if (this.fingers.size === 1) this.moved = 0;
    }

    private up(event: PointerEvent): void {
        const isClick = this.fingers.size === 1 && this.moved <= SLOP && event.button === 0;
        this.fingers.delete(event.pointerId);
        if (!isClick) return;
        const box = this.canvas.getBoundingClientRect();
        this.steered.click(event.clientX - box.left, event.clientY - box.top);
    }

    private drag(event: PointerEvent): void {
        const finger = this.fingers.get(event.pointerId);
        if (!finger) return;
        const x = event.clientX - finger.x;
        const y = event.clientY - finger.y;
        this.moved += Math.abs(x) + Math.abs(y);
        const others = [...this.fingers].filter(([id]) => id !== event.pointerId);
        const other = others[0]?.[1];
        if (other) {
            const before = Math.hypot(finger.x - other.x, finger.y - other.y);
            const after = Math.hypot(event.clientX - other.x, event.clientY - other.y);
            this.walk(-0.003 * x, 0.003 * y, 0.01 * (after - before));
        } else if (event.shiftKey || event.buttons === 2) {
            this.walk(-0.004 * x, 0.004 * y, 0);
        } else if (this.moved > SLOP) {
            this.turn(TURN * x, TURN * y);
        }
        finger.x = event.clientX;
        finger.y = event.clientY;
    }

    private turn(yaw: number, pitch: number): void {
        const pose = this.steered.pose();
        this.steered.move(
            this.way === "walk"
                ? turned(pose, yaw, pitch)
                : orbited(pose, this.centre, -yaw, -pitch),
        );
    }

    private walk(right: number, up: number, ahead: number): void {
        this.steered.move(walked(this.steered.pose(), right, up, ahead));
    }

    private wheel(event: WheelEvent): void {
        event.preventDefault();
        this.walk(0, 0, -0.002 * event.deltaY);
    }

    private key(event: KeyboardEvent): void {
        if (event.ctrlKey || event.altKey || event.metaKey) return;
        if (!(event.code in KEYS) && !(event.code in TURNS)) return;
        event.preventDefault();
        const isFirst = this.keys.size === 0;
        this.keys.add(event.code);
        if (!isFirst) return;
        this.last = performance.now() - TAP; // so that the shortest press moves, however slow frames are
        this.step();
    }

    /** As long as a key is down, a frame each. */
    private step(): void {
        if (this.keys.size === 0) return;
        const now = performance.now();
        const seconds = Math.min((now - this.last) / 1000, 0.1);
        this.last = now;
        for (const code of this.keys) {
            const [right, up, ahead] = KEYS[code] ?? [0, 0, 0];
            const metres = STEP * seconds;
            if (right || up || ahead) this.walk(right * metres, up * metres, ahead * metres);
            const turn = TURNS[code];
            if (turn) this.turn(turn * seconds, 0);
        }
        requestAnimationFrame(() => this.step());
    }
}
