// SPDX-License-Identifier: Apache-2.0
// Of each message what the scene draws, in as few objects as can be: each of them, and above all
// each small array of numbers, costs when it is handed to another thread.
import type {
  CameraModel, FleetDivision, LocalMap, MovingBodies, PlannedTrajectory, PointCloud2, Pose, SafetyState, TargetIntention,
  TargetPrediction, TargetSearch, Vec3,
} from "../data/messages.ts";
import { personKind } from "../data/words.ts";
import { boundsOf, duration_s, homeOf, samplePlan } from "../store/derive.ts";
import type { Heard, Latest } from "../store/state.ts";

const planPoints = 48;

export interface Path { color_rgb: number; probability: number; points: Float32Array }
export interface Plan {
  points: Float32Array;
  tail: number; // from which share on it only stops
  regions: PlannedTrajectory["visible_regions"];
  corridor: PlannedTrajectory["corridor"];
}
export interface Body {
  id: number;
  person: boolean;
  followed: boolean;
  x: number;
  y: number;
  z: number; // of its lowest face
  radius_m: number;
  height_m: number;
  expected: Float32Array; // where it will be, from where it is on
}
export interface Target { status: number; x: number; y: number; z: number; yaw_rad: number | null }

export interface Search {
  mode: number; // 0: nobody is lost
  x: number; // least corner of the belief's first cell
  y: number;
  z: number; // of the person's torso
  cell_m: number;
  columns: number;
  belief: Uint8Array;
  likeliest: Vec3;
  viewpoint: Vec3 | null;
}

/** Where it may fly, and where `return` leads. */
export interface Limits {
  fence: Float64Array; // x, y of each corner
  low_m: number | null;
  high_m: number | null;
  home: Vec3 | null;
}

/** A seat of a fleet: from where one of its vehicles sees the person. */
export interface Seat { vehicle: string; bearing_rad: number; near: boolean }

/** Points are x, y, z triples. */
export interface Sketches {
  "odometry": Pose;
  "target/state": Target;
  "target/observation": CameraModel;
  "target/intention": Pick<TargetIntention, "region_now" | "region_ahead">;
  "target/prediction": Path[];
  "bodies": Body[];
  "plan/trajectory": Plan;
  "target/search": Search;
  "fleet/division": Seat[];
  "safety/state": Limits;
  "map/points": Omit<PointCloud2, "header">;
  "map/local": Omit<LocalMap, "header">;
}
export type Drawn = keyof Sketches;
export type Seen = { [T in Drawn]?: Heard<Sketches[T]> };

/** Of a vehicle that is not chosen, what of these is drawn for it is less. */
export const moreOfChosen: readonly Drawn[] = ["target/intention", "plan/trajectory", "fleet/division",
  "safety/state"];

type Maker<T extends Drawn> = (message: Latest[T]["message"], chosen: boolean) => Sketches[T];

function pathsOf({ paths }: TargetPrediction): Path[] {
  return paths.map(({ color_rgb, probability, states }) =>
    ({ color_rgb, probability, points: flat(states.map((s) => s.position_m)) }));
}

const ahead_s = 1.5; // that a velocity is drawn for

function bodiesOf({ bodies }: MovingBodies): Body[] {
  return bodies.map((body) => {
    const { id, kind, followed, position_m, velocity_mps: v, radius_m, height_m, places_m } = body;
    const [x, y, z] = [position_m[0]!, position_m[1]!, position_m[2]!];
    const places = places_m.length > 0 ? places_m.map((p): Vec3 => [p.x, p.y, p.z])
      : [[x + ahead_s * v[0]!, y + ahead_s * v[1]!, z]];
    return { id, person: kind === personKind, followed, x, y, z, radius_m, height_m, expected: flat([[x, y, z], ...places]) };
  });
}

function searchOf(s: TargetSearch): Search {
  return { mode: s.mode, x: s.corner_m[0]!, y: s.corner_m[1]!, z: s.likeliest_m[2]!,
    cell_m: s.cell_m, columns: s.columns, belief: Uint8Array.from(s.belief),
    likeliest: s.likeliest_m, viewpoint: s.has_viewpoint ? s.viewpoint_m : null };
}

const sectors = 12; // of a ring of seats, the first one towards east

function seatsOf({ seats }: FleetDivision): Seat[] {
  return seats.filter(({ seat }) => seat >= 0).map(({ vehicle, seat, is_near }) =>
    ({ vehicle, bearing_rad: ((seat % sectors) * 2 * Math.PI) / sectors, near: is_near }));
}

function limitsOf(safety: SafetyState, chosen: boolean): Limits {
  const bounds = chosen ? boundsOf(safety) : null;
  return { fence: Float64Array.from(bounds?.fence_m.flat() ?? []),
    low_m: bounds?.altitude_min_m ?? null, high_m: bounds?.altitude_max_m ?? null,
    home: chosen ? homeOf(safety) : null };
}

function planOf(plan: PlannedTrajectory, chosen: boolean): Plan {
  const total_s = duration_s(plan);
  return { points: flat(samplePlan(plan, planPoints)),
    tail: total_s > 0 ? plan.tail_start_s / total_s : 1,
    regions: chosen ? plan.visible_regions : [], corridor: chosen ? plan.corridor : [] };
}

function flat(points: readonly Vec3[]): Float32Array {
  const numbers = new Float32Array(3 * points.length);
  points.forEach((point, i) => {
    for (let axis = 0; axis < 3; axis++) numbers[3 * i + axis] = point[axis]!;
  });
  return numbers;
}

const makers: { [T in Drawn]: Maker<T> } = {
  "odometry": ({ pose }) => pose.pose,
  "target/state": ({ status, position_m: p, body_yaw_rad, body_yaw_variance_rad2 }) =>
    ({ status, x: p[0]!, y: p[1]!, z: p[2]!,
      yaw_rad: body_yaw_variance_rad2 >= 0 ? body_yaw_rad : null }),
  "target/observation": ({ camera }) => camera,
  "target/intention": ({ region_now, region_ahead }) => ({ region_now, region_ahead }),
  "target/prediction": pathsOf,
  "bodies": bodiesOf,
  "plan/trajectory": planOf,
  "target/search": searchOf,
  "fleet/division": seatsOf,
  "safety/state": limitsOf,
  "map/points": ({ height, width, fields, point_step, data }) =>
    ({ height, width, fields, point_step, data }),
  "map/local": ({ resolution_m, origin_m, size_x, size_y, size_z, cells }) =>
    ({ resolution_m, origin_m, size_x, size_y, size_z, cells }),
};
export const drawnTopics = Object.keys(makers) as Drawn[];

export function sketch<T extends Drawn>(topic: T, heard: Latest[T],
                                        chosen: boolean): Heard<Sketches[T]> {
  return { time_s: heard.time_s, message: makers[topic](heard.message, chosen) };
}
