// What is on the screen: one view of the room, or two beside a wipe, drawn when something changed.

import * as THREE from "three";

import type { AddedLight } from "./added_light";
import { place, verticalView } from "./camera";
import { LightMeter } from "./light_meter";
import type { Rgb, Room } from "./room";
import { Trouble } from "./room";
import type { DroppedModels } from "./dropped_models";
import type { RoomScene } from "./room_scene";
import { VIEWS } from "./surface";
import { weightsOf } from "./timeline";
import type { Pose, Show, State } from "./url_state";

const FADE = 200; // ms in which a lamp comes on

function rendererOn(canvas: HTMLCanvasElement): THREE.WebGLRenderer {
    const context = canvas.getContext("webgl2", {
        antialias: true,
        powerPreference: "high-performance",
    });
    const canSum =
        context?.getExtension("EXT_color_buffer_float") ??
        context?.getExtension("EXT_color_buffer_half_float");
    if (!context || !canSum)
        throw new Trouble("This page needs WebGL 2, which this browser or device lacks.");
    return new THREE.WebGLRenderer({ canvas, context, antialias: true });
}

export class Picture {
    readonly renderer: THREE.WebGLRenderer;
    readonly camera = new THREE.PerspectiveCamera(60, 1, 0.01, 200);
    added: AddedLight | null = null;
    models: DroppedModels | null = null;
    onDrawn: () => void = () => undefined;
    private room: RoomScene | null = null;
    private shown: Rgb[] = []; // weights on the screen
    private readonly meter = new LightMeter((isWorthMeasuring) => this.ask(isWorthMeasuring));
    private isLightOld = true;
    private isAsked = false;
    private isMeterOld = true;
    private calls = 0; // to the GPU, of the last frame
    private frame = 0; // ms, of the last one

    constructor(
        private readonly canvas: HTMLCanvasElement,
        private readonly facts: Room,
        private readonly state: () => State,
        private readonly pose: () => Pose,
    ) {
        this.renderer = rendererOn(canvas);
        this.renderer.autoClear = false;
        this.renderer.setClearColor(0x000000, 1);
        new ResizeObserver(() => this.resize()).observe(canvas);
    }

    setRoom(room: RoomScene): void {
        this.room = room;
        this.resize();
    }

    /** To be called after the light was changed, or a lightmap came. */
    lightChanged(): void {
        this.isLightOld = true;
        this.ask();
    }

    /** To be called after anything else was changed; whether the meter may see other light. */
    ask(isWorthMeasuring = true): void {
        this.isMeterOld ||= isWorthMeasuring;
        if (this.isAsked) return;
        this.isAsked = true;
        requestAnimationFrame((now) => this.draw(now));
    }

    get box(): Room["box"] {
        return this.facts.box;
    }

    rayAt(x: number, y: number): THREE.Raycaster {
        const ray = new THREE.Raycaster();
        const { clientWidth, clientHeight } = this.canvas;
        const at = new THREE.Vector2((2 * x) / clientWidth - 1, 1 - (2 * y) / clientHeight);
        ray.setFromCamera(at, this.camera);
        return ray;
    }

    private resize(): void {
        const { clientWidth, clientHeight } = this.canvas;
        if (clientWidth === 0 || clientHeight === 0) return;
        this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
        this.renderer.setSize(clientWidth, clientHeight, false);
        this.camera.aspect = clientWidth / clientHeight;
        this.camera.fov = verticalView(this.facts.camera, this.camera.aspect);
        this.camera.updateProjectionMatrix();
        this.ask();
    }

    /** Weights on the way from those on the screen to those that are wanted; time changes them by itself. */
    private fade(wanted: Rgb[], now: number): boolean {
        const isStill =
            this.state().time !== null ||
            matchMedia("(prefers-reduced-motion: reduce)").matches ||
            this.shown.length === 0;
        const share = isStill ? 1 : Math.min((now - this.frame) / FADE, 0.5);
        let isThere = true;
        this.shown = wanted.map((weight, i) => {
            const from = this.shown[i] ?? weight;
            return weight.map((value, c) => {
                const next = (from[c] ?? 0) + share * (value - (from[c] ?? 0));
                if (share === 1 || Math.abs(value - next) < 0.002) return value;
                isThere = false;
                return next;
            }) as Rgb;
        });
        return isThere;
    }

    private draw(now: number): void {
        this.isAsked = false;
        if (!this.room) return;
        if (this.isLightOld) {
            const wanted = weightsOf(this.facts, this.state());
            if (this.frame < now - 100) this.frame = now - 16;
            this.isLightOld = !this.fade(wanted, now);
            this.room.setLight(this.renderer, this.shown);
            if (this.isLightOld) this.ask();
        }
        this.frame = now;
        const isNew = this.added?.update(this.renderer, this.state().added) ?? false;
        this.models?.update(this.renderer, this.shown, isNew);
        this.drawViews(this.room, now);
        this.measure(this.room);
        this.onDrawn();
        this.canvas.dataset["drawn"] = String(Number(this.canvas.dataset["drawn"] ?? 0) + 1);
    }

    private measure(room: RoomScene): void {
        if (!this.state().isMetered) return this.meter.reset();
        if (!this.isMeterOld) return;
        this.isMeterOld = false;
        void this.meter.measure(this.renderer, room.scene, this.camera, room.uniforms);
    }

    private drawViews(room: RoomScene, now: number): void {
        const state = this.state();
        place(this.camera, this.pose());
        const box = new THREE.Box3(
            new THREE.Vector3(...this.facts.box.low),
            new THREE.Vector3(...this.facts.box.high),
        );
        room.backs.visible = box.containsPoint(this.camera.position);
        const { exposure } = this.facts;
        const stops = state.stops + (state.isMetered ? this.meter.stops(now, exposure) : exposure);
        room.uniforms.exposure.value = 2 ** stops;
        this.canvas.dataset["stops"] = stops.toFixed(2);
        const { width, height } = this.renderer.getSize(new THREE.Vector2());
        const cut = state.against ? Math.round(state.wipe * width) : width;
        this.calls = 0;
        this.renderer.setScissorTest(state.against !== null);
        this.drawPart(room, state.show, 0, cut, height);
        if (state.against) this.drawPart(room, state.against, cut, width - cut, height);
        this.renderer.setScissorTest(false);
        this.canvas.dataset["calls"] = String(this.calls);
    }

    private drawPart(room: RoomScene, show: Show, x: number, width: number, height: number): void {
        if (width <= 0) return;
        this.renderer.setScissor(x, 0, width, height);
        room.uniforms.view.value = VIEWS[show];
        this.renderer.clear();
        this.renderer.render(room.scene, this.camera);
        this.calls += this.renderer.info.render.calls;
    }
}
