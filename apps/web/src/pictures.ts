// Pictures of a page as pixels and as textures.

import * as THREE from "three";

import type { Parts } from "./parts";
import { Trouble } from "./room";
import type { Picture } from "./room";

async function bitmapOf(
    parts: Parts,
    picture: Picture,
    resize: ImageBitmapOptions = {},
): Promise<ImageBitmap> {
    const bytes = await parts.take(picture);
    try {
        return await createImageBitmap(new Blob([bytes], { type: picture.type }), {
            colorSpaceConversion: "none",
            premultiplyAlpha: "none",
            ...resize,
        });
    } catch {
        throw new Trouble(
            `${picture.file}.js holds no picture that can be shown; write the page again with relamp page.`,
        );
    }
}

/** RGBA, row 0 on top. */
export async function pixelsOf(parts: Parts, picture: Picture): Promise<Uint8Array<ArrayBuffer>> {
    const bitmap = await bitmapOf(parts, picture);
    if (bitmap.width !== picture.width || bitmap.height !== picture.height)
        throw new Trouble(`${picture.file}.js is damaged; write the page again with relamp page.`);
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    if (!context) throw new Trouble("This browser draws no pictures.");
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    return new Uint8Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
}

function resizeOf({ width, height }: Picture, most: number): ImageBitmapOptions {
    const share = most / Math.max(width, height);
    if (share >= 1) return {};
    return {
        resizeWidth: Math.max(1, Math.round(width * share)),
        resizeHeight: Math.max(1, Math.round(height * share)),
        resizeQuality: "high",
    };
}

/** An sRGB texture that is smooth from near and far; of more pixels than `most` it is scaled down. */
export async function textureOf(
    parts: Parts,
    picture: Picture,
    { anisotropy, most }: { anisotropy: number; most: number },
): Promise<THREE.Texture> {
    const texture = new THREE.Texture(await bitmapOf(parts, picture, resizeOf(picture, most)));
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.flipY = false;
    texture.generateMipmaps = true;
    texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.magFilter = THREE.LinearFilter;
    texture.anisotropy = anisotropy;
    texture.needsUpdate = true;
    return texture;
}
