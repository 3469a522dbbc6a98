// How a visitor brings models and moves them: a file is dropped into the picture or chosen; a
// drag moves it over what lies level.

import * as THREE from "three";

import { byId, element } from "./dom";
import { MOST_MODELS } from "./dropped_models";
import type { DroppedModels, Model } from "./dropped_models";
import { readModel } from "./model_file";
import { modelRow } from "./model_row";
import { notice } from "./notice";
import type { Picture } from "./picture";
import { Trouble } from "./room";
import type { Rgb } from "./room";
import type { RoomScene } from "./room_scene";

const LEVEL = 0.5; // least y of a normal on which things stand
const LOW = 0.7; // of the height of the picture: where the floor is likely seen
const OFF_WALL = 0.3; // m

export class ModelPlacing {
    private readonly list = element("ul", { class: "lamps", "aria-label": "models" });
    private readonly button = element("button", { type: "button" }, "Bring a model (GLB)");
    private dragged: { model: Model; pointer: number } | null = null;

    /** `changed` is called after models were brought, moved or taken away. */
    constructor(
        private readonly scene: RoomScene,
        private readonly picture: Picture,
        private readonly models: DroppedModels,
        private readonly changed: () => void,
    ) {
        const input = element("input", { type: "file", accept: ".glb,.gltf", hidden: true });
        input.addEventListener("change", () => {
            const file = input.files?.[0];
            const canvas = byId("canvas");
            if (file) void this.bring(file, canvas.clientWidth / 2, LOW * canvas.clientHeight);
            input.value = "";
        });
        this.button.title = "Choose a file, or drop it into the picture";
        this.button.addEventListener("click", () => input.click());
        byId("models").append(element("h2", {}, "Models"), this.list, this.button, input);
        this.takeDrops();
        this.takeDrags();
    }

    /** A file that is dropped on a pixel of the picture. */
    async bring(file: File, x: number, y: number): Promise<void> {
        try {
            if (!this.models.isPossible)
                throw new Trouble(
                    "This page was written by an older relamp; write it again with relamp page.",
                );
            if (!this.models.isReady)
                throw new Trouble(
                    "What models need has not come yet; bring it in a moment, or load the page again.",
                );
            const place = this.levelAt(x, y);
            if (!place) throw new Trouble("Nothing is there for a model to stand on.");
            const model = await readModel(file);
            if (this.models.models.length >= MOST_MODELS)
                throw new Trouble(`There are ${MOST_MODELS} models already; remove one.`);
            this.models.add(file.name.replace(/\.[^.]*$/, ""), model, place);
            this.show();
            this.changed();
        } catch (trouble) {
            notice(
                trouble instanceof Trouble
                    ? trouble.message
                    : `${file.name} cannot be shown (${String(trouble)}).`,
            );
        }
    }

    private takeDrops(): void {
        // Anywhere, or a browser would leave the page for what was dropped beside the picture.
        document.addEventListener("dragover", (event) => event.preventDefault());
        document.addEventListener("drop", (event) => {
            event.preventDefault();
            const file = event.dataTransfer?.files[0];
            if (!file) return;
            const box = byId("stage").getBoundingClientRect();
            const [x, y] = [event.clientX - box.left, event.clientY - box.top];
            const isIn = x >= 0 && y >= 0 && x < box.width && y < box.height;
            void this.bring(file, isIn ? x : box.width / 2, isIn ? y : LOW * box.height);
        });
    }

    /** A drag that begins on a model moves it, and does not turn the visitor. */
    private takeDrags(): void {
        const canvas = byId("canvas");
        const stage = byId("stage");
        const at = (event: PointerEvent) => {
            const box = canvas.getBoundingClientRect();
            return [event.clientX - box.left, event.clientY - box.top] as const;
        };
        const catching = { capture: true };
        stage.addEventListener(
            "pointerdown",
            (event) => {
                if (event.target !== canvas || !event.isPrimary) return;
                const model = this.modelAt(...at(event));
                if (!model) return;
                this.dragged = { model, pointer: event.pointerId };
                event.stopPropagation();
                canvas.setPointerCapture(event.pointerId);
            },
            catching,
        );
        stage.addEventListener(
            "pointermove",
            (event) => {
                if (this.dragged?.pointer !== event.pointerId) return; // or another finger
                event.stopPropagation();
                const place = this.levelAt(...at(event));
                if (!place) return;
                this.dragged.model.root.position.set(...place);
                this.models.moved();
                this.changed();
            },
            catching,
        );
        for (const name of ["pointerup", "pointercancel"] as const)
            stage.addEventListener(
                name,
                (event) => {
                    if (this.dragged?.pointer !== event.pointerId) return;
                    event.stopPropagation();
                    this.dragged = null;
                    this.show();
                },
                catching,
            );
    }

    private modelAt(x: number, y: number): Model | null {
        const ray = this.picture.rayAt(x, y);
        const wall = this.scene.frontAlong(ray)?.distance ?? Infinity;
        const found = this.models.models
            .map((model) => ({
                model,
                distance: ray.intersectObjects(model.meshes, false)[0]?.distance ?? Infinity,
            }))
            .sort((a, b) => a.distance - b.distance)[0];
        return found && found.distance < wall ? found.model : null;
    }

    /** Where something stands that a person puts there: on what is level, or below what is not. */
    private levelAt(x: number, y: number): Rgb | null {
        const hit = this.scene.frontAlong(this.picture.rayAt(x, y));
        if (!hit?.face) return null;
        const normal = hit.face.normal
            .clone()
            .applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(hit.object.matrixWorld));
        if (normal.y >= LEVEL) return hit.point.toArray() as Rgb;
        const beside = hit.point.clone().addScaledVector(normal, OFF_WALL);
        // A skirting may lean below the floor.
        beside.y = Math.max(beside.y, hit.point.y) + OFF_WALL;
        const down = new THREE.Raycaster(beside, new THREE.Vector3(0, -1, 0));
        return (this.scene.frontAlong(down)?.point.toArray() as Rgb | undefined) ?? null;
    }

    private show(): void {
        this.list.replaceChildren(...this.models.models.map((model) => this.rowOf(model)));
    }

    private rowOf(model: Model): HTMLElement {
        return modelRow(model, {
            box: this.picture.box,
            changed: () => {
                this.models.moved();
                this.changed();
            },
            remove: () => {
                this.models.remove(model);
                this.show();
                this.changed();
                this.button.focus();
            },
        });
    }
}
