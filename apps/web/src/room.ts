// What room.js says of a room: include/relamp/page.h and docs/guide/page.md have the words.

export type Rgb = [number, number, number];

export interface Part {
    file: string;
    type: string;
    bytes: number;
}

export interface Picture extends Part {
    width: number;
    height: number;
}

export interface Texture extends Picture {
    smaller?: Picture[]; // the same, largest first
}

export interface Lightmap extends Picture {
    scale: number; // irradiance / pi = scale (byte / 255)^4
}

export interface Box {
    low: number[];
    extent: number[];
}

export interface Place {
    offset: number;
    bytes: number;
}

export interface MeshOfRoom {
    page: number;
    vertices: number;
    triangles: number;
    box: Box;
    uvBox: Box;
    wrap: [string, string];
    vertexData: Place;
    indexData: Place;
}

export interface PageOfRoom {
    first?: Picture; // of albedo, until that has come
    albedo: Texture;
    scan?: Texture;
    shining?: Picture;
    shiningAlbedo?: Rgb; // linear; shown in place of what a lamp hides
}

export interface Shine {
    place: number; // of the fixture among the room's
    radiance: Rgb;
}

export interface Light {
    name: string;
    kind: "lamp" | "window" | "sun" | "sky";
    colour: Rgb;
    fixture?: number;
    shines: Shine[];
    maps: Lightmap[];
}

/** WebTransport of src/output/web_transport.h. */
export interface BouncesOfRoom extends Part {
    clusters: number;
    fronts: number;
    size: number; // m
    points: number;
    rays: number;
    box: Box;
}

/** WebProbes of src/output/web_probes.h. */
export interface ProbesOfRoom extends Part {
    low: Rgb;
    spacing: number; // m
    count: Rgb; // along x, y, z
    rays: number;
    scales: number[]; // of lights
}

export interface RoomCamera {
    position: Rgb;
    forward: Rgb;
    up: Rgb;
    fieldOfView: number; // rad
    across: "width" | "height";
}

export interface Room {
    format: string;
    name: string;
    geometry: Part;
    meshes: MeshOfRoom[];
    pages: PageOfRoom[];
    fixtures: number;
    exposure: number; // stops
    camera: RoomCamera;
    box: { low: Rgb; high: Rgb };
    lights: Light[];
    timeline?: TimelineOfRoom;
    bounces?: BouncesOfRoom;
    probes?: ProbesOfRoom;
}

export interface TimelineOfRoom {
    seconds: number; // that it lasts
    keys: { time: number; name?: string }[];
    times: number[]; // ascending, from the first key to the last
    weights: Rgb[][]; // of each time, of each light
}

const FORMAT = "relamp page 1";

/** What is wrong, as a sentence for whoever looks at the page. */
export class Trouble extends Error {}

const MOST_FIXTURES = 65536; // two bytes of a texel say which it shows

function rows(of: unknown, ...names: string[]): unknown[] {
    return names.map((name) => (of as Record<string, unknown> | null | undefined)?.[name]);
}

function isPlace(row: unknown): boolean {
    return Array.isArray(row) && row.length === 3 && row.every(Number.isFinite);
}

function isTimeline({ keys, times, weights }: TimelineOfRoom, lights: number): boolean {
    return (
        Array.isArray(keys) &&
        keys.length > 1 &&
        Array.isArray(times) &&
        times.length > 1 &&
        Array.isArray(weights) &&
        weights.length === times.length &&
        weights.every((row) => Array.isArray(row) && row.length === lights && row.every(isPlace))
    );
}

/** Throws Trouble where `data` is none of a page of this format. */
export function asRoom(data: unknown): Room {
    const room = (data ?? {}) as Room;
    if (typeof room.format === "string" && room.format !== FORMAT)
        throw new Trouble(
            `room.js is of another version (${room.format}); write the page again with relamp page.`,
        );
    const isWhole =
        room.format === FORMAT &&
        Array.isArray(room.meshes) &&
        Array.isArray(room.pages) &&
        Array.isArray(room.lights) &&
        room.lights.length > 0 &&
        typeof room.geometry === "object" &&
        rows(room.camera, "position", "forward", "up").every(isPlace) &&
        rows(room.box, "low", "high").every(isPlace) &&
        Number.isFinite(room.exposure) &&
        room.fixtures >= 0 &&
        room.fixtures < MOST_FIXTURES &&
        (room.timeline === undefined || isTimeline(room.timeline, room.lights.length));
    if (!isWhole) throw new Trouble("room.js is damaged; write the page again with relamp page.");
    return room;
}

/** All files of a room but room.js, in the order in which they are worth having. */
export function partsOf(room: Room): Part[] {
    const parts: Part[] = [room.geometry];
    for (const page of room.pages) parts.push(page.first ?? page.albedo);
    for (const light of room.lights) parts.push(...light.maps);
    for (const page of room.pages) {
        if (page.shining) parts.push(page.shining);
        if (page.first) parts.push(page.albedo);
        if (page.scan) parts.push(page.scan);
    }
    if (room.bounces) parts.push(room.bounces);
    if (room.probes) parts.push(room.probes);
    return parts;
}
