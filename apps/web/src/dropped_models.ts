// Models that a visitor brought, in the light of the room.

import * as THREE from "three";

import type { AddedLight } from "./added_light";
import { contactShade, modelMaterial } from "./model_material";
import { meshesOf, sensibleScale } from "./model_file";
import type { Parts } from "./parts";
import { Probes } from "./probes";
import type { Rgb, Room } from "./room";
import type { RoomScene } from "./room_scene";

export const MOST_MODELS = 4;

/** A model whose origin is the middle of what it stands on. */
export interface Model {
    name: string;
    root: THREE.Group;
    meshes: THREE.Mesh[];
}

export class DroppedModels {
    readonly models: Model[] = [];
    private probes: Probes | null = null;
    private weights: Rgb[] | null = null;

    constructor(
        private readonly room: Room,
        private readonly scene: RoomScene,
        private readonly added: AddedLight,
    ) {}

    async load(parts: Parts): Promise<void> {
        const about = this.room.probes;
        if (about) this.probes = new Probes(about, await parts.take(about));
    }

    /** Whether the page has what models need, once all of it is loaded. */
    get isPossible(): boolean {
        return this.room.probes !== undefined;
    }

    /** Whether that is there. */
    get isReady(): boolean {
        return this.probes !== null;
    }

    add(name: string, given: THREE.Group, place: Rgb): void {
        if (!this.probes) return;
        const uniforms = { ...this.scene.uniforms, ...this.scene.added, ...this.probes.uniforms() };
        const meshes = meshesOf(given);
        for (const mesh of meshes) {
            if (!mesh.geometry.getAttribute("normal")) mesh.geometry.computeVertexNormals();
            const one = (material: THREE.Material) =>
                modelMaterial(material, uniforms, this.room.exposure);
            mesh.material = Array.isArray(mesh.material)
                ? mesh.material.map(one)
                : one(mesh.material);
        }
        const root = new THREE.Group();
        root.add(this.standing(given));
        root.position.set(...place);
        this.scene.scene.add(root);
        this.models.push({ name, root, meshes });
        this.weights = null;
        this.moved();
    }

    remove(model: Model): void {
        this.models.splice(this.models.indexOf(model), 1);
        this.scene.scene.remove(model.root);
        model.root.traverse((object) => {
            if (!(object instanceof THREE.Mesh)) return;
            object.geometry.dispose();
            const materials: THREE.ShaderMaterial[] = [object.material].flat();
            for (const material of materials) {
                (material.uniforms["map"]?.value as THREE.Texture | null | undefined)?.dispose();
                material.dispose();
            }
        });
        this.moved();
    }

    /** To be called after a model was moved. */
    moved(): void {
        for (const { root } of this.models) root.updateMatrixWorld(true);
        this.added.setObstacles(this.models.flatMap(({ meshes }) => meshes));
    }

    /** Brings the light to what the lamps are set to; `isAddedNew`: added lamps changed. */
    update(renderer: THREE.WebGLRenderer, weights: Rgb[], isAddedNew: boolean): void {
        if (!this.probes || this.models.length === 0) return;
        if (weights === this.weights && !isAddedNew) return;
        this.weights = weights;
        this.probes.update(renderer, weights, this.added.sending);
    }

    /** Of sensible size, on its ground, with the shade that it throws there. */
    private standing(given: THREE.Group): THREE.Group {
        const { low, high } = this.room.box;
        const ofRoom = Math.max(...high.map((value, axis) => value - (low[axis] ?? 0)));
        given.updateMatrixWorld(true);
        const box = new THREE.Box3().setFromObject(given);
        const size = box.getSize(new THREE.Vector3());
        const scale = sensibleScale(Math.max(size.x, size.y, size.z), ofRoom);
        const middle = box.getCenter(new THREE.Vector3());
        const standing = new THREE.Group();
        given.position.sub(new THREE.Vector3(middle.x, box.min.y, middle.z));
        standing.add(given);
        const shade = contactShade(this.scene.uniforms.view);
        shade.scale.set(1.5 * size.x, 1, 1.5 * size.z);
        shade.position.y = 0.004 / scale;
        standing.add(shade);
        standing.scale.setScalar(scale);
        return standing;
    }
}
