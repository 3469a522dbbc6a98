// How a visitor puts up lamps: by a button, or by dragging it into the picture; rings in the
// picture move them.

import * as THREE from "three";

import { MOST_LAMPS, lumensFor } from "./added_lamp";
import { AddedRow } from "./added_row";
import { byId, element } from "./dom";
import { LampRing } from "./lamp_ring";
import type { Picture } from "./picture";
import type { Rgb, Room } from "./room";
import type { RoomScene } from "./room_scene";
import type { State } from "./url_state";

const OFF_SURFACE = 0.25; // m, from where a person points to the lamp
const SLOP = 8; // pixels that a click on the button may move
const KELVIN = 2700;

export interface PlacingActions {
    state(): State;
    changed(): void; // after the state was changed
}

export class LampPlacing {
    private readonly add: HTMLButtonElement;
    private readonly list = element("ul", { class: "lamps", "aria-label": "new lamps" });
    private rows: AddedRow[] = [];
    private rings: LampRing[] = [];
    private from: { x: number; y: number } | null = null; // where the button was pressed

    constructor(
        private readonly room: Room,
        private readonly scene: RoomScene,
        private readonly picture: Picture,
        private readonly actions: PlacingActions,
    ) {
        this.add = element("button", { type: "button", class: "add" }, "Put up a lamp");
        this.add.title = "Click, or drag into the picture";
        this.dragOut();
        byId("added").append(element("h2", {}, "New lamps"), this.list, this.add);
        picture.onDrawn = () => this.rings.forEach((ring) => ring.follow(this.picture.camera));
        this.show();
    }

    /** Brings rows and rings to the lamps that there are. */
    show(): void {
        const { added } = this.actions.state();
        if (this.rows.length !== added.length) this.remake(added.length);
        this.rows.forEach((row) => row.show());
        this.rings.forEach((ring) => ring.follow(this.picture.camera));
        // Not every browser tells a button that is disabled of the drag that began on it.
        this.add.disabled = added.length >= MOST_LAMPS && !this.from;
    }

    private remake(count: number): void {
        for (const ring of this.rings) ring.root.remove();
        const lamp = (i: number) => this.actions.state().added[i];
        const indices = Array.from({ length: count }, (_, i) => i);
        this.rows = indices.map(
            (i) =>
                new AddedRow(i, {
                    lamp: () => lamp(i),
                    box: this.room.box,
                    changed: () => this.changed(),
                    remove: () => {
                        this.actions.state().added.splice(i, 1);
                        this.changed();
                        this.add.focus();
                    },
                }),
        );
        this.list.replaceChildren(...this.rows.map((row) => row.root));
        this.rings = indices.map(
            (i) =>
                new LampRing(i, {
                    place: () => lamp(i)?.position ?? null,
                    move: (position) => {
                        const moved = lamp(i);
                        if (moved) moved.position = position;
                        this.changed();
                    },
                    isOn: () => lamp(i)?.isOn ?? false,
                    toggle: () => {
                        const toggled = lamp(i);
                        if (toggled) toggled.isOn = !toggled.isOn;
                        this.changed();
                    },
                    placeAt: (x, y) => this.placeAt(x, y),
                    yaw: () =>
                        new THREE.Euler().setFromQuaternion(this.picture.camera.quaternion, "YXZ")
                            .y,
                }),
        );
        byId("stage").append(...this.rings.map((ring) => ring.root));
    }

    private changed(): void {
        this.show();
        this.actions.changed();
    }

    /** Where a lamp hangs or stands for who points at a pixel; null: nothing is there. */
    private placeAt(x: number, y: number): Rgb | null {
        const ray = this.picture.rayAt(x, y);
        const hit = this.scene.frontAlong(ray);
        if (!hit?.face) return null;
        const normal = hit.face.normal
            .clone()
            .applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(hit.object.matrixWorld));
        const up = new THREE.Raycaster(hit.point.clone().addScaledVector(normal, 0.01), normal);
        const over = up.intersectObjects(this.scene.meshes, false)[0]?.distance ?? Infinity;
        return hit.point.addScaledVector(normal, Math.min(OFF_SURFACE, over / 2)).toArray() as Rgb;
    }

    private put(position: Rgb | null): void {
        const { added } = this.actions.state();
        if (!position || added.length >= MOST_LAMPS) return;
        added.push({ position, lumens: lumensFor(this.room.exposure), kelvin: KELVIN, isOn: true });
        this.changed();
    }

    /** A click puts a lamp where the visitor looks; a drag where it ends, the lamp goes along. */
    private dragOut(): void {
        let isOut = false;
        const canvas = byId("canvas");
        const inPicture = (event: PointerEvent) => {
            const box = canvas.getBoundingClientRect();
            const [x, y] = [event.clientX - box.left, event.clientY - box.top];
            return x >= 0 && y >= 0 && x < box.width && y < box.height ? this.placeAt(x, y) : null;
        };
        this.add.addEventListener("pointerdown", (event) => {
            if (this.add.disabled) return;
            this.from = { x: event.clientX, y: event.clientY };
            isOut = false;
            this.add.setPointerCapture(event.pointerId);
        });
        this.add.addEventListener("pointermove", (event) => {
            const { from } = this;
            if (!from || Math.hypot(event.clientX - from.x, event.clientY - from.y) < SLOP) return;
            const place = inPicture(event);
            if (!place) return;
            const last = this.actions.state().added.at(-1);
            if (!isOut) this.put(place);
            else if (last) {
                last.position = place;
                this.changed();
            }
            isOut = true;
        });
        this.add.addEventListener("lostpointercapture", () => {
            this.from = null;
            this.show();
        });
        this.add.addEventListener("click", () => {
            if (!isOut) this.put(this.placeAt(canvas.clientWidth / 2, canvas.clientHeight / 2));
            isOut = false;
        });
    }
}
