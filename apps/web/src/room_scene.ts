// The room on the GPU: its surfaces, their textures, and the light on them.

import * as THREE from "three";

import { addedUniforms } from "./added_shader";
import { decoderIsReady, geometryOf, matrixOf, uvOf } from "./geometry";
import { LightSum } from "./light_sum";
import type { Parts } from "./parts";
import { pixelsOf, textureOf } from "./pictures";
import type { MeshOfRoom, PageOfRoom, Rgb, Room } from "./room";
import {
    backMaterial,
    beyondHoles,
    commonUniforms,
    emissionTexture,
    surfaceMaterial,
    wrappingOf,
} from "./surface";

/** What the GPU takes. */
export interface Limits {
    anisotropy: number;
    most: number; // pixels along a side
}

/** Whose the texels of a page are, for who points at one. */
interface ShiningMap {
    width: number;
    height: number;
    channels: 1 | 4; // R alone tells of fewer than 255 fixtures
    pixels: Uint8Array<ArrayBuffer>;
}

/** Every fourth byte. */
function firstChannel(rgba: Uint8Array): Uint8Array<ArrayBuffer> {
    const red = new Uint8Array(rgba.length / 4);
    for (let i = 0; i < red.length; ++i) red[i] = rgba[4 * i] ?? 0;
    return red;
}

export class RoomScene {
    readonly scene = new THREE.Scene();
    readonly uniforms = commonUniforms();
    readonly added = addedUniforms();
    readonly meshes: THREE.Mesh[] = [];
    readonly hasScan: boolean;
    readonly backs = new THREE.Group(); // hidden from outside: near walls are taken away
    private readonly back = backMaterial();
    private readonly sums: LightSum[];
    private readonly shining: (ShiningMap | null)[];
    private readonly emission: THREE.DataTexture;
    private readonly materials: THREE.ShaderMaterial[][];

    constructor(private readonly room: Room) {
        this.hasScan = room.pages.every((page) => page.scan !== undefined);
        this.emission = emissionTexture(room.fixtures);
        this.shining = room.pages.map(() => null);
        this.materials = room.pages.map(() => []);
        this.scene.add(beyondHoles(this.uniforms), this.backs);
        this.sums = room.pages.map((_, p) => {
            const first = room.lights[0]?.maps[p];
            return new LightSum(
                first?.width ?? 1,
                first?.height ?? 1,
                room.lights.map((light) => light.maps[p]?.scale ?? 0),
            );
        });
    }

    /** Loads what the first picture needs, then the rest; `onMore` is told of every piece. */
    async load(parts: Parts, limits: Limits, onMore: () => void): Promise<void> {
        await decoderIsReady();
        const bytes = await parts.take(this.room.geometry);
        for (const mesh of this.room.meshes) this.addMesh(mesh, bytes);
        for (const [p, page] of this.room.pages.entries())
            this.setTexture(p, "albedo", await textureOf(parts, page.first ?? page.albedo, limits));
        for (const [i, light] of this.room.lights.entries())
            for (const [p, map] of light.maps.entries()) {
                this.sums[p]?.setMap(i, await pixelsOf(parts, map));
                onMore();
            }
        for (const [p, page] of this.room.pages.entries()) {
            await this.loadRest(parts, page, p, limits);
            onMore();
        }
    }

    /** Weights are of the lights, a channel each. */
    setLight(renderer: THREE.WebGLRenderer, weights: Rgb[]): void {
        for (const sum of this.sums) sum.sum(renderer, weights);
        const data = this.emission.image.data as Float32Array;
        data.fill(0);
        this.room.lights.forEach((light, i) => {
            const weight = weights[i] ?? [0, 0, 0];
            if (Math.max(...weight) <= 0) return;
            for (const { place, radiance } of light.shines) {
                for (let c = 0; c < 3; ++c)
                    data[4 * place + c] =
                        (data[4 * place + c] ?? 0) + (weight[c] ?? 0) * (radiance[c] ?? 0);
                data[4 * place + 3] = 1;
            }
        });
        this.emission.needsUpdate = true;
        this.uniforms.sky.value = this.skyUnder(weights);
    }

    /** Radiance of what lies beyond holes. */
    private skyUnder(weights: Rgb[]): THREE.Vector3 {
        const sum = new THREE.Vector3();
        this.room.lights.forEach((light, i) => {
            if (light.kind === "sky")
                sum.add(
                    new THREE.Vector3(...light.colour).multiply(
                        new THREE.Vector3(...(weights[i] ?? [0, 0, 0])),
                    ),
                );
        });
        return sum;
    }

    /** Light of added lamps by way of surfaces; null: none. */
    setBounced(page: number, texture: THREE.Texture | null): void {
        for (const material of this.materials[page] ?? [])
            material.uniforms["bounced"]!.value = texture;
    }

    /** The first front that a ray meets. */
    frontAlong(ray: THREE.Raycaster): THREE.Intersection | undefined {
        return ray.intersectObjects(this.meshes, false).find(({ face, object }) => {
            if (!face) return false;
            const normal = face.normal
                .clone()
                .applyNormalMatrix(new THREE.Matrix3().getNormalMatrix(object.matrixWorld));
            return normal.dot(ray.ray.direction) < 0;
        });
    }

    /** Place of the fixture that a ray meets; null where it meets none. */
    fixtureAlong(ray: THREE.Raycaster): number | null {
        const hit = this.frontAlong(ray);
        if (!hit?.uv) return null;
        const mesh = hit.object.userData["mesh"] as MeshOfRoom;
        const map = this.shining[mesh.page];
        if (!map) return null;
        const [u, v] = uvOf(mesh, hit.uv.x, hit.uv.y);
        return placeNear(map, Math.floor(u * map.width), Math.floor(v * map.height));
    }

    private addMesh(mesh: MeshOfRoom, bytes: Uint8Array): void {
        const material = surfaceMaterial(
            {
                albedo: null,
                scan: null,
                shading: this.sums[mesh.page]?.texture ?? new THREE.Texture(),
                bounced: null,
                shining: null,
                emission: this.emission,
            },
            [...mesh.uvBox.low, ...mesh.uvBox.extent],
            this.room.pages[mesh.page]?.shiningAlbedo ?? [0.5, 0.5, 0.5],
            this.uniforms,
            this.added,
        );
        this.materials[mesh.page]?.push(material);
        const geometry = geometryOf(mesh, bytes);
        const front = new THREE.Mesh(geometry, material);
        front.userData["mesh"] = mesh;
        this.meshes.push(front);
        const back = new THREE.Mesh(geometry, this.back);
        this.backs.add(back);
        for (const drawn of [front, back]) {
            drawn.matrixAutoUpdate = false;
            drawn.matrix.copy(matrixOf(mesh));
            drawn.updateMatrixWorld(true);
        }
        this.scene.add(front);
    }

    private setTexture(page: number, name: string, texture: THREE.Texture): void {
        (this.materials[page]?.[0]?.uniforms[name]?.value as THREE.Texture | null)?.dispose();
        const wrap = this.room.meshes.find((mesh) => mesh.page === page)?.wrap;
        if (wrap && name !== "shining") {
            texture.wrapS = wrappingOf(wrap[0]);
            texture.wrapT = wrappingOf(wrap[1]);
        }
        for (const material of this.materials[page] ?? []) {
            const uniform = material.uniforms[name];
            if (uniform) uniform.value = texture;
        }
    }

    private async loadRest(
        parts: Parts,
        page: PageOfRoom,
        p: number,
        limits: Limits,
    ): Promise<void> {
        if (page.shining) {
            const { width, height } = page.shining;
            const rgba = await pixelsOf(parts, page.shining);
            const isFew = this.room.fixtures < 255;
            const pixels = isFew ? firstChannel(rgba) : rgba;
            this.shining[p] = { width, height, channels: isFew ? 1 : 4, pixels };
            const format = isFew ? THREE.RedFormat : THREE.RGBAFormat;
            const texture = new THREE.DataTexture(pixels, width, height, format);
            texture.unpackAlignment = 1;
            texture.needsUpdate = true;
            this.setTexture(p, "shining", texture);
        }
        if (page.first) this.setTexture(p, "albedo", await textureOf(parts, page.albedo, limits));
        if (page.scan) this.setTexture(p, "scan", await textureOf(parts, page.scan, limits));
    }
}

/** A lamp is small where a finger points at it: also texels beside. */
function placeNear(map: ShiningMap, column: number, row: number): number | null {
    for (const reach of [0, 1, 2])
        for (let y = row - reach; y <= row + reach; ++y)
            for (let x = column - reach; x <= column + reach; ++x) {
                const at = map.channels * (y * map.width + x);
                const high = map.channels === 1 ? 0 : (map.pixels[at + 1] ?? 0);
                const id = (map.pixels[at] ?? 0) + 256 * high;
                if (id > 0) return id - 1;
            }
    return null;
}
