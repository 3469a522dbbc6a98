// A ring around an added lamp in the picture: drag moves the lamp along surfaces, keys move it
// anywhere.

import * as THREE from "three";

import { element } from "./dom";
import type { Rgb } from "./room";

const STEP = 0.05; // m that a key moves
const SLOP = 4; // pixels that a click may move

export interface RingActions {
    place(): Rgb | null;
    move(position: Rgb): void;
    isOn(): boolean;
    toggle(): void;
    placeAt(x: number, y: number): Rgb | null; // CSS pixels of the picture
    yaw(): number; // of who looks, rad
}

// To the right, up, ahead, as the visitor stands.
const KEYS: Record<string, Rgb> = {
    ArrowLeft: [-1, 0, 0],
    ArrowRight: [1, 0, 0],
    ArrowUp: [0, 0, 1],
    ArrowDown: [0, 0, -1],
    PageUp: [0, 1, 0],
    PageDown: [0, -1, 0],
};

export class LampRing {
    readonly root: HTMLButtonElement;
    private readonly from = new THREE.Vector2();
    private isMoved = false;

    constructor(
        lamp: number,
        private readonly actions: RingActions,
    ) {
        this.root = element("button", {
            type: "button",
            class: "ring",
            title: "Drag to move; with shift up and down; click to switch",
            "aria-label": `new lamp ${lamp + 1}: arrow keys, page up and page down move it`,
        });
        this.root.addEventListener("pointerdown", (event) => this.down(event));
        this.root.addEventListener("pointermove", (event) => this.drag(event));
        this.root.addEventListener("click", () => {
            if (!this.isMoved) this.actions.toggle();
            this.isMoved = false;
        });
        this.root.addEventListener("keydown", (event) => this.key(event));
    }

    /** Stands where the lamp is seen. */
    follow(camera: THREE.PerspectiveCamera): void {
        const place = this.actions.place();
        const seen = place && new THREE.Vector3(...place).project(camera);
        this.root.hidden =
            !seen || Math.abs(seen.z) > 1 || Math.abs(seen.x) > 1 || Math.abs(seen.y) > 1;
        if (!seen || this.root.hidden) return;
        this.root.classList.toggle("off", !this.actions.isOn());
        this.root.style.left = `${50 * (seen.x + 1)}%`;
        this.root.style.top = `${50 * (1 - seen.y)}%`;
    }

    private down(event: PointerEvent): void {
        this.root.setPointerCapture(event.pointerId);
        this.from.set(event.clientX, event.clientY);
        this.isMoved = false;
    }

    private drag(event: PointerEvent): void {
        if (!this.root.hasPointerCapture(event.pointerId)) return;
        const at = new THREE.Vector2(event.clientX, event.clientY);
        if (!this.isMoved && at.distanceTo(this.from) < SLOP) return;
        this.isMoved = true;
        const place = this.actions.place();
        if (event.shiftKey && place) {
            this.actions.move([place[0], place[1] - 0.005 * (at.y - this.from.y), place[2]]);
        } else {
            const box = this.root.parentElement?.getBoundingClientRect();
            const next = box && this.actions.placeAt(at.x - box.left, at.y - box.top);
            if (next) this.actions.move(next);
        }
        this.from.copy(at);
    }

    private key(event: KeyboardEvent): void {
        const way = KEYS[event.key];
        const place = this.actions.place();
        if (!way || !place) return;
        event.preventDefault();
        const [right, up, ahead] = way.map((value) => STEP * value) as Rgb;
        const [sin, cos] = [Math.sin(this.actions.yaw()), Math.cos(this.actions.yaw())];
        this.actions.move([
            place[0] + right * cos - ahead * sin,
            place[1] + up,
            place[2] - right * sin - ahead * cos,
        ]);
    }
}
