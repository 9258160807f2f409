// SPDX-License-Identifier: Apache-2.0
// What is drawn over a picture, in its own pixels: everybody who is known, ways, the plan.
import { type Header, type MovingBodies, type MovingBody, seconds,
} from "../data/messages.ts";
import { personKind } from "../data/words.ts";
import { samplePlan } from "../store/derive.ts";
import { age_s, type State, type Vehicle } from "../store/state.ts";
import { stale_s } from "../store/watch.ts";
import { colorOfRgb } from "../ui/palette.ts";
import { mountOf, type Pixel, type Point, poseAt, project, projectLine, type View,
} from "./project.ts";

/** Somebody who can be pointed at. */
export interface Somebody {
  id: number;
  followed: boolean;
  person: boolean;
  distance_m: number | null;
}
export interface Box extends Somebody {
  left: number;
  top: number;
  right: number;
  bottom: number;
  seen: boolean; // in an image; else it is where they are thought to be
}
export interface Way { color: string; share: number; pieces: Pixel[][] }
export interface Overlay {
  width: number; // of the picture, px
  height: number;
  boxes: Box[];
  bones: [Pixel, Pixel][];
  ways: Way[];
  plan: Pixel[][];
}

const apart_s = 0.25; // an image and what was seen in it
const torso_m = 1.2; // of the middle of the torso over the ground
// BlazePose's joints.
const joints = [[11, 12], [11, 23], [12, 24], [23, 24], [11, 13], [13, 15], [12, 14], [14, 16],
  [23, 25], [25, 27], [24, 26], [26, 28], [7, 0], [0, 8]] as const;

/** When the image was taken that shows them. */
function lookStamp(bodies: MovingBodies, stamp_s: number): number {
  const ages = bodies.bodies.map((b) => b.look_age_s ?? -1).filter((age) => age >= 0);
  return ages.length > 0 ? stamp_s - Math.min(...ages) : stamp_s;
}

/** Whose pixels boxes and landmarks count. */
function fullWidth({ latest }: Vehicle): number | null {
  return latest["camera/color/camera_info"]?.message.width ??
    (latest["target/observation"]?.message.camera.width_px || null);
}

/** null: the camera or the vehicle's pose then is not known. */
export function viewOf(state: State, vehicle: Vehicle, header: Header): View | null {
  const info = vehicle.latest["camera/ground/camera_info"]?.message;
  const pose = poseAt(vehicle.poses, seconds(header.stamp));
  if (!info || !pose) return null;
  return { info, mount: mountOf(state, vehicle, header.frame_id), vehicle: pose };
}

function distanceTo(body: MovingBody, view: View): number {
  const { x, y } = view.vehicle.position;
  return Math.hypot(body.position_m[0]! - x, body.position_m[1]! - y);
}

/** Where the cylinder stands in the picture; null: out of it. */
function placeBox(body: MovingBody, view: View): Pixel[] | null {
  const [x, y, z] = [body.position_m[0]!, body.position_m[1]!, body.position_m[2]!];
  const { position } = view.vehicle;
  const along = Math.atan2(y - position.y, x - position.x);
  const [sx, sy] = [-Math.sin(along) * body.radius_m, Math.cos(along) * body.radius_m];
  const corners = [[x + sx, y + sy, z], [x - sx, y - sy, z], [x + sx, y + sy, z + body.height_m],
    [x - sx, y - sy, z + body.height_m]].map((corner) => project(view, corner as unknown as Point));
  return corners.every((corner) => corner !== null) ? (corners as Pixel[]) : null;
}

function boxOf(body: MovingBody, view: View | null, scale: number | null): Box | null {
  const seen = (body.look_age_s ?? -1) >= 0 && scale !== null && body.box_px !== undefined;
  const distance_m = view && distanceTo(body, view);
  const common = { id: body.id, followed: body.followed, person: body.kind === personKind, seen,
    distance_m };
  if (seen) {
    const [left, top, right, bottom] = Array.from(body.box_px!, (px) => px * scale);
    return { ...common, left: left!, top: top!, right: right!, bottom: bottom! };
  }
  const corners = view && placeBox(body, view);
  if (!corners) return null;
  const [xs, ys] = [corners.map((c) => c[0]), corners.map((c) => c[1])];
  return { ...common, left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys),
    bottom: Math.max(...ys) };
}

const isOn = (box: Box, width: number, height: number): boolean =>
  box.right > 0 && box.left < width && box.bottom > 0 && box.top < height;

function bonesOf(bodies: MovingBody[], scale: number | null): [Pixel, Pixel][] {
  if (scale === null) return [];
  return bodies.flatMap(({ landmarks = [] }) => joints.flatMap(([a, b]): [Pixel, Pixel][] => {
    const [from, to] = [landmarks[a], landmarks[b]];
    if (!from || !to || from.visibility < 0.4 || to.visibility < 0.4) return [];
    return [[[from.image_x_px * scale, from.image_y_px * scale],
      [to.image_x_px * scale, to.image_y_px * scale]]];
  }));
}

function waysOf(state: State, vehicle: Vehicle, view: View, ground_m: number): Way[] {
  const heard = vehicle.latest["target/prediction"];
  if (!heard || age_s(state, heard) > stale_s) return [];
  return heard.message.paths.map(({ color_rgb, probability, states }) => ({
    color: colorOfRgb(color_rgb), share: probability,
    pieces: projectLine(view, states.map(({ position_m: p }): Point => [p[0]!, p[1]!, ground_m])),
  }));
}

function planOf(state: State, vehicle: Vehicle, view: View): Pixel[][] {
  const heard = vehicle.latest["plan/trajectory"];
  if (!heard || age_s(state, heard) > stale_s) return [];
  return projectLine(view, samplePlan(heard.message, 24));
}

export function overlayOf(state: State, vehicle: Vehicle, header: Header,
                          size: { width: number; height: number }): Overlay {
  const { width, height } = size;
  const stamp_s = seconds(header.stamp);
  const view = viewOf(state, vehicle, header);
  const full = fullWidth(vehicle);
  const scale = full === null ? null : width / full;
  const nearest = vehicle.looks.nearest(stamp_s, lookStamp);
  const near = nearest !== undefined &&
    Math.abs(lookStamp(nearest, seconds(nearest.header.stamp)) - stamp_s) < apart_s;
  const bodies = near ? nearest.bodies : [];
  const followed = bodies.find((body) => body.followed);
  const target = vehicle.latest["target/state"]?.message;
  const ground_m = followed?.position_m[2] ?? (target ? target.position_m[2]! - torso_m : 0);
  return {
    width, height,
    boxes: bodies.map((body) => boxOf(body, view, scale))
      .filter((box): box is Box => box !== null && isOn(box, width, height)),
    bones: bonesOf(bodies.filter((b) => (b.look_age_s ?? -1) >= 0), scale),
    ways: view ? waysOf(state, vehicle, view, ground_m) : [],
    plan: view ? planOf(state, vehicle, view) : [],
  };
}

/** Who is there; of several the one in front, whose box is the smaller. margin: for fingers, px. */
export function boxAt(overlay: Overlay, x: number, y: number, margin: number): Box | null {
  const hits = overlay.boxes.filter((b) => x > b.left - margin && x < b.right + margin &&
    y > b.top - margin && y < b.bottom + margin);
  const area = (b: Box): number => (b.right - b.left) * (b.bottom - b.top);
  return hits.sort((a, b) => area(a) - area(b))[0] ?? null;
}
