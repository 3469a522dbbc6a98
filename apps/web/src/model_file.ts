// Reads a GLB that a visitor brings.

import { MeshoptDecoder } from "meshoptimizer/decoder";
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

import { Trouble } from "./room";

const MOST_BYTES = 100e6;
const MOST_METRES = 1e6; // from the origin; beyond, and as no number at all, a file is broken
const LEAST_SIZE = 0.03; // m of a thing that stands in a room
const SHARE_OF_ROOM = 0.8; // of its longer side; what is larger was made in other units
const SIZE_OF_SMALL = 0.3; // m, of what was smaller
const SHARE_OF_LARGE = 0.25; // of the room's longer side, of what was larger

/** Nothing but what is in the file is loaded. */
function onlyOwn(url: string): string {
    if (/^(blob|data):/.test(url)) return url;
    throw new Trouble("it names other files; bring a GLB that has all in it");
}

function reasonOf(error: string): string {
    if (error.includes("DRACO")) return "it is packed by Draco; save it without";
    if (error.includes("KTX2")) return "its textures are KTX2; save them as PNG or JPEG";
    return "it is no whole GLB (glTF 2.0)";
}

/** A model as it is in its file. Throws Trouble with a sentence. */
export async function readModel(file: File): Promise<THREE.Group> {
    const refuse = (why: string) => new Trouble(`${file.name} cannot be shown: ${why}.`);
    if (file.size > MOST_BYTES) throw refuse("it has more than 100 MB");
    const loader = new GLTFLoader(new THREE.LoadingManager().setURLModifier(onlyOwn));
    loader.setMeshoptDecoder(MeshoptDecoder);
    let scene: THREE.Group | undefined; // a file may have none
    try {
        scene = (await loader.parseAsync(await file.arrayBuffer(), "")).scene;
    } catch (error) {
        if (error instanceof Trouble) throw refuse(error.message);
        throw refuse(reasonOf(String(error)));
    }
    if (!scene || meshesOf(scene).length === 0) throw refuse("there are no triangles in it");
    const { min, max } = new THREE.Box3().setFromObject(scene);
    if (![...min.toArray(), ...max.toArray()].every((value) => Math.abs(value) < MOST_METRES))
        throw refuse("some of its triangles lie nowhere: save it again");
    return scene;
}

export function meshesOf(scene: THREE.Object3D): THREE.Mesh[] {
    const meshes: THREE.Mesh[] = [];
    scene.traverse((object) => {
        if (!(object instanceof THREE.Mesh)) return;
        const geometry = object.geometry as THREE.BufferGeometry;
        if (!geometry.hasAttribute("position")) return;
        if ((geometry.index ?? geometry.getAttribute("position")).count >= 3) meshes.push(object);
    });
    return meshes;
}

/** What a model is to be multiplied by so that it can stand in a room. */
export function sensibleScale(size: number, sizeOfRoom: number): number {
    if (!(size > 0)) return 1;
    if (size < LEAST_SIZE) return SIZE_OF_SMALL / size;
    if (size > SHARE_OF_ROOM * sizeOfRoom) return (SHARE_OF_LARGE * sizeOfRoom) / size;
    return 1;
}
