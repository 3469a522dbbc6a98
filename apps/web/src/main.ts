// Puts the page together.

import * as THREE from "three";

import { AddedLight } from "./added_light";
import { DroppedModels } from "./dropped_models";
import { LampPlacing } from "./lamp_placing";
import { ModelPlacing } from "./model_placing";
import { poseOf } from "./camera";
import { byId } from "./dom";
import { fittingRoom, mostSide } from "./levels";
import { loadAnewAfterLoss } from "./lost_context";
import { trouble } from "./notice";
import { Panel } from "./panel";
import { Parts, loadRoom } from "./parts";
import { Picture } from "./picture";
import { Trouble } from "./room";
import type { Room } from "./room";
import { RoomScene } from "./room_scene";
import { Steering } from "./steering";
import { takeTime } from "./timeline";
import { hashOf, stateFrom } from "./url_state";
import type { State } from "./url_state";
import { Wipe } from "./wipe";

const URL_PAUSE = 250; // ms without a change, after which the address is

function sentenceOf(reason: unknown): string {
    if (reason instanceof Trouble) return reason.message;
    return `This page cannot be shown here (${String(reason)}).`;
}

function say(reason: unknown): void {
    trouble(sentenceOf(reason));
    byId("preview").hidden = false;
    byId("progress").hidden = true;
    document.body.dataset["state"] = "trouble";
}

function showProgress(share: number): void {
    (byId("progress") as HTMLProgressElement).value = share;
    if (share >= 1) byId("progress").hidden = true;
}

class App {
    private state: State;
    private readonly picture: Picture;
    private timer = 0;

    constructor(private readonly room: Room) {
        this.state = this.stateOfAddress();
        const canvas = byId("canvas") as HTMLCanvasElement;
        this.picture = new Picture(
            canvas,
            room,
            () => this.state,
            () => this.pose(),
        );
        loadAnewAfterLoss(canvas, () => this.keep());
    }

    async start(): Promise<void> {
        const { capabilities } = this.picture.renderer;
        const limits = {
            anisotropy: capabilities.getMaxAnisotropy(),
            most: mostSide(capabilities.maxTextureSize),
        };
        const room = fittingRoom(this.room, limits.most);
        const scene = new RoomScene(room);
        if (!scene.hasScan && this.state.show === "scan") this.state.show = "relit";
        const panel = this.controls(scene);
        const parts = new Parts("", room, showProgress);
        const added = new AddedLight(room, scene);
        const models = new DroppedModels(room, scene, added);
        this.picture.added = added;
        this.picture.models = models;
        new ModelPlacing(scene, this.picture, models, () => {
            panel.relit();
            this.picture.ask();
        });
        this.picture.setRoom(scene);
        await scene.load(parts, limits, () => {
            byId("preview").hidden = true;
            this.picture.lightChanged();
        });
        try {
            await added.load(parts);
            await models.load(parts);
        } catch (reason) {
            trouble(sentenceOf(reason)); // of what a visitor may add; the room is there
            byId("progress").hidden = true;
        }
        this.picture.ask();
        panel.show();
        document.body.dataset["state"] = "ready";
    }

    private stateOfAddress(): State {
        const state = stateFrom(location.hash, this.room.lights.length);
        takeTime(this.room, state);
        return state;
    }

    private pose() {
        return this.state.pose ?? poseOf(this.room.camera);
    }

    private controls(scene: RoomScene): Panel {
        const { low, high } = this.room.box;
        const centre = new THREE.Vector3(...low).add(new THREE.Vector3(...high)).divideScalar(2);
        const wipe = new Wipe(
            byId("wipe"),
            () => this.state,
            () => this.changed(false),
        );
        const steering = new Steering(byId("canvas"), centre, {
            pose: () => this.pose(),
            move: (pose) => {
                this.state.pose = pose;
                this.changed(false);
            },
            click: (x, y) => this.click(scene, panel, x, y),
        });
        const panel: Panel = new Panel(this.room, scene.hasScan, {
            state: () => this.state,
            changed: (isLight) => {
                wipe.show();
                this.changed(isLight);
            },
            setWay: (way) => (steering.way = way),
            goHome: () => {
                this.state.pose = null;
                this.changed(false);
            },
        });
        const placing = new LampPlacing(this.room, scene, this.picture, {
            state: () => this.state,
            changed: () => {
                panel.relit();
                this.changed(false);
            },
        });
        byId("panel").hidden = !this.state.hasPanel;
        window.addEventListener("hashchange", () => {
            this.state = this.stateOfAddress();
            byId("panel").hidden = !this.state.hasPanel;
            panel.show();
            wipe.show();
            placing.show();
            this.picture.lightChanged();
        });
        return panel;
    }

    /** A lamp that is clicked is switched. */
    private click(scene: RoomScene, panel: Panel, x: number, y: number): void {
        const fixture = scene.fixtureAlong(this.picture.rayAt(x, y));
        if (fixture === null) return;
        const light = this.room.lights.findIndex(
            ({ shines, kind }) => kind !== "sky" && shines.some(({ place }) => place === fixture),
        );
        if (light >= 0) panel.toggle(light);
    }

    private changed(isLight: boolean): void {
        if (isLight) this.picture.lightChanged();
        else this.picture.ask();
        window.clearTimeout(this.timer);
        this.timer = window.setTimeout(() => this.keep(), URL_PAUSE);
    }

    /** Puts the state into the address. */
    private keep(): void {
        const hash = hashOf(this.state);
        history.replaceState(null, "", hash ? `#${hash}` : location.pathname);
    }
}

async function main(): Promise<void> {
    try {
        const room = await loadRoom("");
        document.title = `${room.name} · relamp`;
        byId("title").textContent = room.name;
        await new App(room).start();
    } catch (reason) {
        say(reason);
    }
}

void main();
