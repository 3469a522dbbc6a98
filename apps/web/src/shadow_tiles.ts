// How far light of added lamps goes: for each of them the depth of the room on six faces of a
// cube, all in one texture.

import * as THREE from "three";

import { MOST_LAMPS } from "./added_lamp";
import type { Rgb } from "./room";

const NEAR = 0.02; // m
const FAR = 100;

/** The shader's axes: `up` of a face is the axis behind its own, `right` the one behind that. */
function poseFace(camera: THREE.Camera, face: number, place: Rgb): void {
    const axis = face >> 1;
    const sign = face % 2 === 0 ? 1 : -1;
    const unit = (i: number, length: number) => new THREE.Vector3().setComponent(i % 3, length);
    const basis = new THREE.Matrix4().makeBasis(
        unit(axis + 2, sign),
        unit(axis + 1, 1),
        unit(axis, -sign),
    );
    camera.position.set(...place);
    camera.quaternion.setFromRotationMatrix(basis);
    camera.updateMatrixWorld();
}

export class ShadowTiles {
    readonly texture: THREE.DepthTexture;
    private readonly target: THREE.WebGLRenderTarget;
    private readonly scene = new THREE.Scene();
    private readonly camera = new THREE.PerspectiveCamera(90, 1, NEAR, FAR);
    private readonly obstacles = new THREE.Group();
    private readonly material = new THREE.MeshBasicMaterial({
        colorWrite: false,
        side: THREE.DoubleSide,
    });
    private known: string[] = [];

    constructor(
        readonly side: number,
        casters: THREE.Mesh[],
    ) {
        const [width, height] = [6 * side, MOST_LAMPS * side];
        this.texture = new THREE.DepthTexture(width, height, THREE.UnsignedIntType);
        this.target = new THREE.WebGLRenderTarget(width, height, {
            depthTexture: this.texture,
            minFilter: THREE.NearestFilter,
            magFilter: THREE.NearestFilter,
        });
        this.scene.add(...casters.map((caster) => this.copyOf(caster)), this.obstacles);
    }

    /** What stands in the room beside its own surfaces. */
    setObstacles(meshes: THREE.Mesh[]): void {
        this.obstacles.clear();
        if (meshes.length > 0) this.obstacles.add(...meshes.map((mesh) => this.copyOf(mesh)));
        this.known = [];
    }

    private copyOf({ geometry, matrixWorld }: THREE.Mesh): THREE.Mesh {
        const mesh = new THREE.Mesh(geometry, this.material);
        mesh.matrixAutoUpdate = false;
        mesh.matrix.copy(matrixWorld);
        mesh.updateMatrixWorld(true);
        return mesh;
    }

    /** Looks anew from lamps that are elsewhere than they were. */
    look(renderer: THREE.WebGLRenderer, places: Rgb[]): void {
        places.forEach((place, lamp) => {
            const word = place.join();
            if (this.known[lamp] === word) return;
            this.known[lamp] = word;
            for (let face = 0; face < 6; ++face) this.lookOn(renderer, lamp, face, place);
        });
    }

    private lookOn(renderer: THREE.WebGLRenderer, lamp: number, face: number, place: Rgb): void {
        poseFace(this.camera, face, place);
        const { side } = this;
        this.target.viewport.set(face * side, lamp * side, side, side);
        this.target.scissor.copy(this.target.viewport);
        this.target.scissorTest = true;
        renderer.setRenderTarget(this.target);
        renderer.clear();
        renderer.render(this.scene, this.camera);
        renderer.setRenderTarget(null);
    }
}

/** Needs `shadowTiles`, `shadowSide`. */
export const SHADOW_LOOKUP = `
uniform highp sampler2D shadowTiles;
uniform int shadowSide; // pixels of a face

// Share of the way from a lamp at which the first surface lies on it; beyond 1: behind its end.
float shareOfWay(int lamp, vec3 way) {
    vec3 size = abs(way);
    int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    float ahead = size[axis];
    float side = way[axis] < 0.0 ? -1.0 : 1.0;
    vec2 at = vec2(side * way[(axis + 2) % 3], way[(axis + 1) % 3]) / ahead;
    ivec2 texel = ivec2(floor((0.5 * at + 0.5) * float(shadowSide)));
    texel = clamp(texel, ivec2(0), ivec2(shadowSide - 1));
    texel += shadowSide * ivec2(2 * axis + (side < 0.0 ? 1 : 0), lamp);
    float depth = 2.0 * texelFetch(shadowTiles, texel, 0).r - 1.0;
    const float near = ${NEAR.toFixed(2)};
    const float far = ${FAR.toFixed(1)};
    float first = 2.0 * near * far / (far + near - depth * (far - near));
    return first / ahead;
}
`;
