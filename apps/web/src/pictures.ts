// Pictures of a page as pixels and as textures.

import * as THREE from "three";

import type { Parts } from "./parts";
import { Trouble } from "./room";
import type { Picture } from "./room";

async function bitmapOf(parts: Parts, picture: Picture, isFlipped: boolean): Promise<ImageBitmap> {
    const bytes = await parts.take(picture);
    try {
        return await createImageBitmap(new Blob([bytes], { type: picture.type }), {
            colorSpaceConversion: "none",
            premultiplyAlpha: "none",
            imageOrientation: isFlipped ? "flipY" : "none",
        });
    } catch {
        throw new Trouble(
            `${picture.file}.js holds no picture that can be shown; write the page again with relamp page.`,
        );
    }
}

/** RGBA, row 0 on top. */
export async function pixelsOf(
    parts: Parts,
    picture: Picture,
): Promise<Uint8Array<ArrayBuffer>> {
    const bitmap = await bitmapOf(parts, picture, false);
    const canvas = document.createElement("canvas");
    canvas.width = bitmap.width;
    canvas.height = bitmap.height;
    const context = canvas.getContext("2d", { willReadFrequently: true });
    if (!context) throw new Trouble("This browser draws no pictures.");
    context.drawImage(bitmap, 0, 0);
    bitmap.close();
    return new Uint8Array(context.getImageData(0, 0, canvas.width, canvas.height).data.buffer);
}

/** An sRGB texture that is smooth from near and far. */
export async function textureOf(
    parts: Parts,
    picture: Picture,
    anisotropy: number,
): Promise<THREE.Texture> {
    const texture = new THREE.Texture(await bitmapOf(parts, picture, false));
    texture.colorSpace = THREE.SRGBColorSpace;
    texture.flipY = false;
    texture.generateMipmaps = true;
    texture.minFilter = THREE.LinearMipmapLinearFilter;
    texture.magFilter = THREE.LinearFilter;
    texture.anisotropy = anisotropy;
    texture.needsUpdate = true;
    return texture;
}
