// The light of the lamps that a visitor puts up: at once straight from them, and by way of
// surfaces as soon as the page has what that needs.

import * as THREE from "three";

import { LAMP_RADIUS, MOST_LAMPS, intensityOf, radianceOf } from "./added_lamp";
import type { AddedLamp } from "./added_lamp";
import { AtlasTaps, cellUniforms } from "./atlas_taps";
import { Bounces, transportFrom } from "./bounces";
import type { Transport } from "./bounces";
import { VIEW_TRANSFORM } from "./formulas";
import type { Parts } from "./parts";
import { isPhone } from "./levels";
import type { MeshOfRoom, Room } from "./room";
import type { RoomScene } from "./room_scene";
import { ShadowTiles } from "./shadow_tiles";

const SIDE = 512; // pixels of a face of a shadow's cube
const SIDE_OF_PHONE = 256;
const MOST_TEXELS = 512; // of bounced light along a side: it is smooth

const BODY = `
precision highp float;
uniform int view;
uniform float exposure;
uniform vec3 radiance;
layout(location = 0) out vec4 pixel;
${VIEW_TRANSFORM}
void main() {
    if (view < 2) discard;
    pixel = vec4(view == 3 ? radiance : srgbOf(agxOf(exposure * radiance)), 1.0);
}`;

export class AddedLight {
    private readonly bodies: THREE.Mesh<THREE.SphereGeometry, THREE.ShaderMaterial>[];
    private shadows: ShadowTiles | null = null;
    private transport: Transport | null = null;
    private bounces: Bounces | null = null;
    private taps: AtlasTaps[] = [];
    private shown = "";
    private obstacles: THREE.Mesh[] = [];

    constructor(
        private readonly room: Room,
        private readonly scene: RoomScene,
    ) {
        const ball = new THREE.SphereGeometry(LAMP_RADIUS, 32, 16);
        this.bodies = Array.from({ length: MOST_LAMPS }, () => {
            const material = new THREE.ShaderMaterial({
                glslVersion: THREE.GLSL3,
                fragmentShader: BODY,
                uniforms: { radiance: { value: new THREE.Vector3() } },
            });
            Object.assign(material.uniforms, scene.uniforms);
            const body = new THREE.Mesh(ball, material);
            body.visible = false;
            scene.scene.add(body);
            return body;
        });
    }

    /** What bounces need; a page of before has none. */
    async load(parts: Parts): Promise<void> {
        if (!this.room.bounces) return;
        this.transport = transportFrom(this.room.bounces, await parts.take(this.room.bounces));
        this.shown = "";
    }

    /** What stands in the room and casts shadows. */
    setObstacles(meshes: THREE.Mesh[]): void {
        this.obstacles = meshes;
        this.shadows?.setObstacles(meshes);
        this.shown = "";
    }

    /** Radiance of clusters by the lamps; null before it is known. */
    get sending(): THREE.Texture | null {
        return this.bounces?.sending ?? null;
    }

    /** Brings the light to the lamps; true where something was to do. */
    update(renderer: THREE.WebGLRenderer, lamps: AddedLamp[]): boolean {
        const wanted = JSON.stringify(lamps);
        if (wanted === this.shown) return false;
        if (this.scene.meshes.length === 0) return false; // is still to come
        this.shown = wanted;
        const { added } = this.scene;
        added.lamps.value = lamps.length;
        this.bodies.forEach((body, i) => this.place(body, lamps[i]));
        if (lamps.length === 0) {
            for (const [page] of this.taps.entries()) this.scene.setBounced(page, null);
            this.bounces?.forget();
            return true;
        }
        lamps.forEach((lamp, i) => {
            added.lampPlace.value[i]?.set(...lamp.position);
            added.lampIntensity.value[i]?.set(...intensityOf(lamp));
        });
        if (!this.shadows) {
            this.shadows = new ShadowTiles(isPhone() ? SIDE_OF_PHONE : SIDE, this.scene.meshes);
            this.shadows.setObstacles(this.obstacles);
        }
        this.shadows.look(
            renderer,
            lamps.map(({ position }) => position),
        );
        added.shadowTiles.value = this.shadows.texture;
        added.shadowSide.value = this.shadows.side;
        this.follow(renderer);
        return true;
    }

    private place(
        body: THREE.Mesh<THREE.SphereGeometry, THREE.ShaderMaterial>,
        lamp?: AddedLamp,
    ): void {
        body.visible = lamp?.isOn ?? false;
        if (!lamp) return;
        body.position.set(...lamp.position);
        (body.material.uniforms["radiance"]!.value as THREE.Vector3).set(...radianceOf(lamp));
    }

    private follow(renderer: THREE.WebGLRenderer): void {
        if (!this.transport) return;
        if (!this.bounces) this.prepare(renderer, this.transport);
        this.bounces?.follow(renderer);
        this.taps.forEach((taps, page) => {
            taps.update(renderer);
            this.scene.setBounced(page, taps.light.texture);
        });
    }

    private prepare(renderer: THREE.WebGLRenderer, transport: Transport): void {
        const bounces = new Bounces(transport, this.scene.added);
        const cells = cellUniforms(transport);
        this.bounces = bounces;
        this.taps = this.room.pages.map((_, page) => {
            const surfaces = this.scene.meshes
                .map((mesh) => ({ mesh, about: mesh.userData["mesh"] as MeshOfRoom }))
                .filter(({ about }) => about.page === page)
                .map(({ mesh, about }) => ({
                    mesh,
                    uvBox: [...about.uvBox.low, ...about.uvBox.extent],
                }));
            const { width = 1, height = 1 } = this.room.lights[0]?.maps[page] ?? {};
            const share = Math.min(1, MOST_TEXELS / Math.max(width, height));
            const size = { width: Math.ceil(share * width), height: Math.ceil(share * height) };
            return new AtlasTaps(renderer, surfaces, cells, bounces, size);
        });
    }
}
