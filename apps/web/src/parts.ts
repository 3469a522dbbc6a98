// Files of a page are scripts that hand over base64: from a disk, browsers load nothing else.

import { Trouble, asRoom, partsOf } from "./room";
import type { Part, Room } from "./room";

type Receivers = {
    relampRoom?: (data: unknown) => void;
    relampPart?: (name: string, base64: string) => void;
};

const AGAIN = "write the page again with relamp page.";

export function bytesFromBase64(text: string): Uint8Array<ArrayBuffer> {
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < binary.length; ++i) bytes[i] = binary.charCodeAt(i);
    return bytes;
}

/** Runs `base`NAME.js; what it does not hand over to `take` is damaged. */
function runScript(url: string, name: string, hasCome: () => boolean): Promise<void> {
    return new Promise((resolve, reject) => {
        const script = document.createElement("script");
        script.src = url;
        script.onload = () => {
            script.remove();
            if (hasCome()) resolve();
            else reject(new Trouble(`${name} is damaged; ${AGAIN}`));
        };
        script.onerror = () => reject(new Trouble(`${name} is missing; ${AGAIN}`));
        document.head.append(script);
    });
}

export async function loadRoom(base: string): Promise<Room> {
    let data: unknown;
    let hasCome = false;
    (window as Receivers).relampRoom = (given) => {
        data = given;
        hasCome = true;
    };
    await runScript(`${base}room.js`, "room.js", () => hasCome);
    return asRoom(data);
}

/** The parts of a room, asked for in the order of their worth. */
export class Parts {
    private readonly arrived = new Map<string, Uint8Array<ArrayBuffer>>();
    private readonly coming = new Map<string, Promise<void>>();

    constructor(
        private readonly base: string,
        room: Room,
        private readonly onProgress: (share: number) => void,
    ) {
        (window as Receivers).relampPart = (name, base64) => {
            this.arrived.set(name, bytesFromBase64(base64));
        };
        const all = partsOf(room);
        this.total = all.reduce((sum, part) => sum + part.bytes, 0);
        let last = Promise.resolve();
        for (const part of all) {
            last = last.catch(() => undefined).then(() => this.load(part));
            this.coming.set(part.file, last);
        }
        last.catch(() => undefined); // whoever asks for a part is told
    }

    /** The bytes of a part, once; throws Trouble. */
    async take(part: Part): Promise<Uint8Array<ArrayBuffer>> {
        await this.coming.get(part.file);
        const bytes = this.arrived.get(part.file);
        if (!bytes) throw new Trouble(`${part.file}.js is missing; ${AGAIN}`);
        this.arrived.delete(part.file);
        return bytes;
    }

    private readonly total: number;
    private loaded = 0;

    private async load(part: Part): Promise<void> {
        const name = `${part.file}.js`;
        await runScript(`${this.base}${name}`, name, () => this.arrived.has(part.file));
        if (this.arrived.get(part.file)?.length !== part.bytes)
            throw new Trouble(`${name} is damaged; ${AGAIN}`);
        this.loaded += part.bytes;
        this.onProgress(this.loaded / this.total);
    }
}
