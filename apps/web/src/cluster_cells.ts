// Which clusters may matter to a place: lists of those near each cell of the room.

import * as THREE from "three";

import type { Transport } from "./bounces";

const MOST_CELLS = 1 << 18;
const WIDTH = 1024; // of the textures

function table(values: Uint32Array, channels: 1 | 2): THREE.DataTexture {
    const texels = values.length / channels;
    const rows = Math.max(Math.ceil(texels / WIDTH), 1);
    const data = new Uint32Array(WIDTH * rows * channels);
    data.set(values);
    const texture = new THREE.DataTexture(
        data,
        WIDTH,
        rows,
        channels === 1 ? THREE.RedIntegerFormat : THREE.RGIntegerFormat,
        THREE.UnsignedIntType,
    );
    texture.internalFormat = channels === 1 ? "R32UI" : "RG32UI";
    texture.needsUpdate = true;
    return texture;
}

export class ClusterCells {
    readonly low: THREE.Vector3;
    readonly count: THREE.Vector3;
    readonly size: number;
    readonly lists: number[][];

    /** Lists those fronts that are within `reach` of some place of a cell. */
    constructor(transport: Transport, reach: number) {
        const box = new THREE.Box3();
        const places = transport.clusters
            .slice(0, transport.fronts)
            .map(({ place }) => new THREE.Vector3(...place));
        for (const place of places) box.expandByPoint(place);
        box.expandByScalar(0.01);
        const extent = box.getSize(new THREE.Vector3());
        let size = transport.size;
        const cells = () =>
            extent
                .clone()
                .divideScalar(size)
                .ceil()
                .max(new THREE.Vector3(1, 1, 1));
        while (cells().x * cells().y * cells().z > MOST_CELLS) size *= 1.25;
        this.low = box.min;
        this.count = cells();
        this.size = size;
        const { x: wide, y: high, z: deep } = this.count;
        this.lists = Array.from({ length: wide * high * deep }, () => []);
        places.forEach((place, i) => this.insert(place, reach, i));
    }

    uniforms(): Record<string, { value: unknown }> {
        const ranges = new Uint32Array(2 * this.lists.length);
        let begin = 0;
        this.lists.forEach((list, i) => {
            ranges.set([begin, list.length], 2 * i);
            begin += list.length;
        });
        return {
            cells: { value: table(ranges, 2) },
            members: { value: table(Uint32Array.from(this.lists.flat()), 1) },
            cellsLow: { value: this.low },
            cellsCount: { value: this.count.toArray() },
            cellSize: { value: this.size },
        };
    }

    private insert(place: THREE.Vector3, reach: number, cluster: number): void {
        const at = place.clone().sub(this.low);
        const range = (axis: number) => {
            const last = this.count.getComponent(axis) - 1;
            const cell = (metres: number) =>
                Math.min(Math.max(Math.floor(metres / this.size), 0), last);
            return [
                cell(at.getComponent(axis) - reach),
                cell(at.getComponent(axis) + reach),
            ] as const;
        };
        const [x, y, z] = [range(0), range(1), range(2)];
        for (let k = z[0]; k <= z[1]; ++k)
            for (let j = y[0]; j <= y[1]; ++j)
                for (let i = x[0]; i <= x[1]; ++i)
                    if (this.distanceTo(at, i, j, k) < reach)
                        this.lists[(k * this.count.y + j) * this.count.x + i]?.push(cluster);
    }

    private distanceTo(at: THREE.Vector3, i: number, j: number, k: number): number {
        const away = (value: number, cell: number) =>
            Math.max(cell * this.size - value, value - (cell + 1) * this.size, 0);
        return Math.hypot(away(at.x, i), away(at.y, j), away(at.z, k));
    }
}
