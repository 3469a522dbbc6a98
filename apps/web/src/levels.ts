// Textures come in several sizes: which of them a device loads, and which it shows first.

import type { PageOfRoom, Picture, Room, Texture } from "./room";

const FIRST_LOOK = 1024; // pixels of the longer side, at most
const SIDE_OF_PHONE = 2048; // 4096 of several textures is more than its memory
const WIDTH_OF_PHONE = 600; // CSS pixels of a screen's shorter side

const longerSide = ({ width, height }: Picture) => Math.max(width, height);

export function isPhone(): boolean {
    return Math.min(screen.width, screen.height) < WIDTH_OF_PHONE;
}

/** Pixels of the longer side of a texture that this device holds; `largest` is what its GPU takes. */
export function mostSide(largest: number): number {
    return isPhone() ? Math.min(largest, SIDE_OF_PHONE) : largest;
}

/** The largest of no more than `most`; else the smallest. */
function fitting(texture: Texture, most: number): Texture {
    const all = [texture, ...(texture.smaller ?? [])];
    return all.find((level) => longerSide(level) <= most) ?? all[all.length - 1] ?? texture;
}

/** The room as a device loads it that holds textures of `most` pixels. */
export function fittingRoom(room: Room, most: number): Room {
    const pages = room.pages.map((page): PageOfRoom => {
        const albedo = fitting(page.albedo, most);
        const first = fitting(page.albedo, FIRST_LOOK);
        return {
            ...page,
            albedo,
            ...(page.scan ? { scan: fitting(page.scan, most) } : {}),
            ...(longerSide(first) < longerSide(albedo) ? { first } : {}),
        };
    });
    return { ...room, pages };
}
