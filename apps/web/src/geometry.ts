// Surfaces as src/output/web_geometry.h writes them.

import { MeshoptDecoder } from "meshoptimizer/decoder";
import * as THREE from "three";

import { Trouble } from "./room";
import type { MeshOfRoom, Place } from "./room";

const BYTES_OF_VERTEX = 12;

export async function decoderIsReady(): Promise<void> {
    if (!MeshoptDecoder.supported)
        throw new Trouble("This browser lacks WebAssembly, which the room's surfaces need.");
    await MeshoptDecoder.ready;
}

function cut(bytes: Uint8Array, place: Place): Uint8Array {
    return bytes.subarray(place.offset, place.offset + place.bytes);
}

/** Positions in metres: share of the mesh's box, which the matrix makes a place. */
export function matrixOf(mesh: MeshOfRoom): THREE.Matrix4 {
    const [x = 0, y = 0, z = 0] = mesh.box.low;
    const [width = 1, height = 1, depth = 1] = mesh.box.extent;
    return new THREE.Matrix4()
        .makeTranslation(x, y, z)
        .multiply(new THREE.Matrix4().makeScale(width, height, depth));
}

/** Throws Trouble where the bytes are damaged. */
export function geometryOf(mesh: MeshOfRoom, bytes: Uint8Array): THREE.BufferGeometry {
    const vertices = new Uint8Array(mesh.vertices * BYTES_OF_VERTEX);
    const corners = new Uint32Array(mesh.triangles * 3);
    try {
        MeshoptDecoder.decodeVertexBuffer(
            vertices,
            mesh.vertices,
            BYTES_OF_VERTEX,
            cut(bytes, mesh.vertexData),
        );
        MeshoptDecoder.decodeIndexBuffer(
            new Uint8Array(corners.buffer),
            corners.length,
            4,
            cut(bytes, mesh.indexData),
        );
    } catch {
        throw new Trouble("geometry.js is damaged; write the page again with relamp page.");
    }
    const shares = new THREE.InterleavedBuffer(new Uint16Array(vertices.buffer), 6);
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute("position", new THREE.InterleavedBufferAttribute(shares, 3, 0, true));
    geometry.setAttribute("uv", new THREE.InterleavedBufferAttribute(shares, 2, 4, true));
    geometry.setAttribute("facing", new THREE.InterleavedBufferAttribute(shares, 1, 3, true));
    geometry.setIndex(new THREE.BufferAttribute(corners, 1));
    geometry.boundingSphere = new THREE.Sphere(new THREE.Vector3(0.5, 0.5, 0.5), 0.87);
    return geometry;
}

/** Texture coordinates of a share of the mesh's box of them. */
export function uvOf(mesh: MeshOfRoom, u: number, v: number): [number, number] {
    const [lowU = 0, lowV = 0] = mesh.uvBox.low;
    const [extentU = 1, extentV = 1] = mesh.uvBox.extent;
    return [lowU + u * extentU, lowV + v * extentV];
}
