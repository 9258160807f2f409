// SPDX-License-Identifier: Apache-2.0
// From the world into the picture: the camera, where it sits, where the vehicle was.
import type { CameraInfo, Odometry, Pose, Quaternion, TransformStamped, Xyz,
} from "../data/messages.ts";
import type { History } from "../store/history.ts";
import type { State, Vehicle } from "../store/state.ts";

export type Pixel = [number, number];
export type Point = readonly [number, number, number];

/** How the world is seen in one picture; pixels are the picture's. */
export interface View { info: CameraInfo; mount: Pose; vehicle: Pose }

const nearest_m = 0.15; // to the camera's plane: what is nearer is not drawn

/** Looks ahead from the body's origin: camera z ahead, x right. */
const ahead: Pose = { position: { x: 0, y: 0, z: 0 },
  orientation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 } };

export function rotate(q: Quaternion, v: Xyz): Xyz {
  const [tx, ty, tz] = [2 * (q.y * v.z - q.z * v.y), 2 * (q.z * v.x - q.x * v.z),
    2 * (q.x * v.y - q.y * v.x)];
  return { x: v.x + q.w * tx + q.y * tz - q.z * ty, y: v.y + q.w * ty + q.z * tx - q.x * tz,
    z: v.z + q.w * tz + q.x * ty - q.y * tx };
}

const conjugate = (q: Quaternion): Quaternion => ({ x: -q.x, y: -q.y, z: -q.z, w: q.w });

function multiply(a: Quaternion, b: Quaternion): Quaternion {
  return { w: a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
    x: a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    y: a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
    z: a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w };
}

function into(pose: Pose, p: Xyz): Xyz {
  const { position: o, orientation } = pose;
  return rotate(conjugate(orientation), { x: p.x - o.x, y: p.y - o.y, z: p.z - o.z });
}

/** Between two poses; the quaternion straight, as they are near. */
function between(a: Pose, b: Pose, share: number): Pose {
  const mix = (x: number, y: number): number => x + share * (y - x);
  const [p, q] = [a.orientation, b.orientation];
  const sign = p.x * q.x + p.y * q.y + p.z * q.z + p.w * q.w < 0 ? -1 : 1;
  const r = { x: mix(p.x, sign * q.x), y: mix(p.y, sign * q.y), z: mix(p.z, sign * q.z),
    w: mix(p.w, sign * q.w) };
  const norm = Math.hypot(r.x, r.y, r.z, r.w) || 1;
  return {
    position: { x: mix(a.position.x, b.position.x), y: mix(a.position.y, b.position.y),
      z: mix(a.position.z, b.position.z) },
    orientation: { x: r.x / norm, y: r.y / norm, z: r.z / norm, w: r.w / norm },
  };
}

/** Where the vehicle was then; null: not known within a third of a second. */
export function poseAt(poses: History<Odometry>, stamp_s: number): Pose | null {
  const { before, after } = poses.around(stamp_s);
  if (before && after) {
    const share = (stamp_s - before.stamp_s) / (after.stamp_s - before.stamp_s);
    return between(before.value.pose.pose, after.value.pose.pose, share);
  }
  const only = before ?? after;
  return only && Math.abs(only.stamp_s - stamp_s) < 0.3 ? only.value.pose.pose : null;
}

/** Through tf_static, from the camera's frame up to the body's. */
function mountOfTransforms(mounts: Map<string, TransformStamped>, vehicle: string,
                           frame: string): Pose | null {
  let pose: Pose | null = null;
  let at = frame.replace(/^\//, "");
  for (let i = 0; i < 6; i++) {
    if (at.endsWith("base_link")) return pose;
    const step: TransformStamped | undefined = mounts.get(`${vehicle}/${at}`) ?? mounts.get(at);
    if (!step) return null;
    const { translation: position, rotation: orientation } = step.transform;
    if (pose === null) pose = { position, orientation };
    else {
      const p = rotate(orientation, pose.position);
      pose = { orientation: multiply(orientation, pose.orientation),
        position: { x: p.x + position.x, y: p.y + position.y, z: p.z + position.z } };
    }
    at = step.header.frame_id.replace(/^\//, "");
  }
  return null;
}

/** As transforms say; else as perception says with what it sees; else it is taken to look ahead. */
export function mountOf(state: State, vehicle: Vehicle, frame: string): Pose {
  return mountOfTransforms(state.mounts, vehicle.name, frame) ??
    vehicle.latest["target/observation"]?.message.camera.pose_body ?? ahead;
}

// Lenses of the kind "plumb bob"; what is far outside of the picture folds back, and is left as it is.
function bend(d: ArrayLike<number>, x: number, y: number): Pixel {
  const [k1 = 0, k2 = 0, p1 = 0, p2 = 0, k3 = 0] = Array.from(d);
  const r2 = x * x + y * y;
  if (r2 > 2) return [x, y];
  const radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  return [x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x),
    y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y];
}

function onPicture({ info }: View, { x, y, z }: Xyz): Pixel {
  const { k, d, distortion_model } = info;
  const [u, v] = distortion_model === "plumb_bob" ? bend(d, x / z, y / z) : [x / z, y / z];
  return [k[0]! * u + k[2]!, k[4]! * v + k[5]!];
}

const inCamera = (view: View, [x, y, z]: Point): Xyz =>
  into(view.mount, into(view.vehicle, { x, y, z }));

/** null: behind the camera. It may be outside of the picture. */
export function project(view: View, point: Point): Pixel | null {
  const p = inCamera(view, point);
  return p.z < nearest_m ? null : onPicture(view, p);
}

/** A way through the world, in pieces where it goes behind the camera. */
export function projectLine(view: View, points: Point[]): Pixel[][] {
  const pieces: Pixel[][] = [];
  let piece: Pixel[] = [];
  let last: Xyz | null = null;
  for (const point of points) {
    const p = inCamera(view, point);
    const crosses = last !== null && (last.z < nearest_m) !== (p.z < nearest_m);
    if (crosses) {
      const share = (nearest_m - last!.z) / (p.z - last!.z);
      const mix = (a: number, b: number): number => a + share * (b - a);
      piece.push(onPicture(view, { x: mix(last!.x, p.x), y: mix(last!.y, p.y), z: nearest_m }));
    }
    if (p.z >= nearest_m) piece.push(onPicture(view, p));
    else if (piece.length > 0) {
      pieces.push(piece);
      piece = [];
    }
    last = p;
  }
  if (piece.length > 0) pieces.push(piece);
  return pieces.filter((pixels) => pixels.length > 1);
}
