// Where a visitor stands and looks.

import * as THREE from "three";

import type { RoomCamera } from "./room";
import type { Pose } from "./url_state";

const STEEPEST = Math.PI / 2 - 0.01;
const NARROWEST = 0.85; // width by height for which the field of view is made

export function poseOf(camera: RoomCamera): Pose {
    const [x, y, z] = camera.forward;
    return { position: [...camera.position], yaw: Math.atan2(-x, -z), pitch: Math.asin(y) };
}

/** Vertical, degrees, as three.js wants it. On a phone that stands, less is seen across. */
export function verticalView(camera: RoomCamera, aspect: number): number {
    const half =
        camera.across === "height"
            ? camera.fieldOfView / 2
            : Math.atan(Math.tan(camera.fieldOfView / 2) / Math.max(aspect, NARROWEST));
    return THREE.MathUtils.radToDeg(2 * half);
}

export function forwardOf({ yaw, pitch }: Pose): THREE.Vector3 {
    return new THREE.Vector3(
        -Math.sin(yaw) * Math.cos(pitch),
        Math.sin(pitch),
        -Math.cos(yaw) * Math.cos(pitch),
    );
}

export function turned(pose: Pose, yaw: number, pitch: number): Pose {
    return {
        ...pose,
        yaw: pose.yaw + yaw,
        pitch: THREE.MathUtils.clamp(pose.pitch + pitch, -STEEPEST, STEEPEST),
    };
}

/** Metres to the right, up and ahead; ahead is level. */
export function walked(pose: Pose, right: number, up: number, ahead: number): Pose {
    const [x, y, z] = pose.position;
    const sin = Math.sin(pose.yaw);
    const cos = Math.cos(pose.yaw);
    return {
        ...pose,
        position: [x + right * cos - ahead * sin, y + up, z - right * sin - ahead * cos],
    };
}

/** Around `centre`, whose distance stays. */
export function orbited(pose: Pose, centre: THREE.Vector3, yaw: number, pitch: number): Pose {
    const next = turned(pose, yaw, pitch);
    const before = frameOf(pose);
    const offset = new THREE.Vector3(...pose.position).sub(centre);
    offset.applyQuaternion(before.invert()).applyQuaternion(frameOf(next)).add(centre);
    return { ...next, position: [offset.x, offset.y, offset.z] };
}

function frameOf({ yaw, pitch }: Pose): THREE.Quaternion {
    return new THREE.Quaternion().setFromEuler(new THREE.Euler(pitch, yaw, 0, "YXZ"));
}

export function place(camera: THREE.PerspectiveCamera, pose: Pose): void {
    camera.position.set(...pose.position);
    camera.quaternion.copy(frameOf(pose));
    camera.updateMatrixWorld();
}
