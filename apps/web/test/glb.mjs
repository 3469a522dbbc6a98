// A GLB for tests: a ball of one colour, some metres across.

export function ballGlb(radius, colour) {
    const [around, up] = [24, 12];
    const points = [];
    for (let j = 0; j <= up; ++j)
        for (let i = 0; i <= around; ++i) {
            const [a, b] = [(2 * Math.PI * i) / around, (Math.PI * j) / up];
            points.push([Math.sin(b) * Math.cos(a), Math.cos(b), Math.sin(b) * Math.sin(a)]);
        }
    const corners = [];
    for (let j = 0; j < up; ++j)
        for (let i = 0; i < around; ++i) {
            const at = j * (around + 1) + i;
            corners.push(at, at + 1, at + around + 1, at + 1, at + around + 2, at + around + 1);
        }
    const places = Float32Array.from(points.flat().map((value) => radius * value));
    const normals = Float32Array.from(points.flat());
    const indices = Uint16Array.from(corners);
    const binary = Buffer.concat([places, normals, indices].map((a) => Buffer.from(a.buffer)));
    const length = places.byteLength;
    const most = radius;
    const json = {
        asset: { version: "2.0" },
        scene: 0,
        scenes: [{ nodes: [0] }],
        nodes: [{ mesh: 0, translation: [5, 5, 5] }],
        meshes: [
            { primitives: [{ attributes: { POSITION: 0, NORMAL: 1 }, indices: 2, material: 0 }] },
        ],
        materials: [
            { pbrMetallicRoughness: { baseColorFactor: [...colour, 1], metallicFactor: 0 } },
        ],
        buffers: [{ byteLength: binary.length }],
        bufferViews: [
            { buffer: 0, byteOffset: 0, byteLength: length },
            { buffer: 0, byteOffset: length, byteLength: length },
            { buffer: 0, byteOffset: 2 * length, byteLength: indices.byteLength },
        ],
        accessors: [
            {
                bufferView: 0,
                componentType: 5126,
                count: points.length,
                type: "VEC3",
                min: [-most, -most, -most],
                max: [most, most, most],
            },
            { bufferView: 1, componentType: 5126, count: points.length, type: "VEC3" },
            { bufferView: 2, componentType: 5123, count: indices.length, type: "SCALAR" },
        ],
    };
    const chunk = (bytes, kind, filler) => {
        const padded = Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4, filler)]);
        const head = Buffer.alloc(8);
        head.writeUInt32LE(padded.length, 0);
        head.write(kind, 4, "latin1");
        return Buffer.concat([head, padded]);
    };
    const body = Buffer.concat([
        chunk(Buffer.from(JSON.stringify(json)), "JSON", " "),
        chunk(binary, "BIN\0", 0),
    ]);
    const head = Buffer.alloc(12);
    head.write("glTF", 0, "latin1");
    head.writeUInt32LE(2, 4);
    head.writeUInt32LE(12 + body.length, 8);
    return Buffer.concat([head, body]);
}

/** Drops bytes as a file onto a pixel of the picture. */
export async function drop(page, name, bytes, x, y) {
    const data = await page.evaluateHandle(
        ({ name, base64 }) => {
            const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
            const transfer = new DataTransfer();
            transfer.items.add(new File([bytes], name));
            return transfer;
        },
        { name, base64: bytes.toString("base64") },
    );
    await page.dispatchEvent("#stage", "drop", { dataTransfer: data, clientX: x, clientY: y });
}
