// SPDX-License-Identifier: Apache-2.0
// Quantities that no topic carries.
import type { Odometry, PlannedTrajectory, Quaternion, SafetyState, TargetState, TrajectoryPiece,
  Vec3,
} from "../data/messages.ts";
import { Track } from "../data/words.ts";
import type { State, Vehicle } from "./state.ts";

export function yawOf(q: Quaternion): number {
  return Math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z));
}

export function wrap(angle_rad: number): number {
  return Math.atan2(Math.sin(angle_rad), Math.cos(angle_rad));
}

/** Horizontal, from the vehicle to the estimated person; null: not known. */
export function distance_m(odometry?: Odometry, target?: TargetState): number | null {
  if (!odometry || !target || target.status === Track.none) return null;
  const from = odometry.pose.pose.position;
  return Math.hypot(target.position_m[0]! - from.x, target.position_m[1]! - from.y);
}

/** A parameter that a service of the vehicle tells with its diagnostic; NaN: none does. */
export function toldBy(state: State, vehicle: Vehicle, key: string): number {
  for (const { message } of state.diagnostics.values()) {
    if (message.hardware_id !== vehicle.name) continue;
    const found = message.values.find((v) => v.key === key);
    if (found) return Number(found.value);
  }
  return NaN;
}

/** The distances that its planner keeps, about the one that was ordered if one was; null: unknown. */
export function band_m(state: State, vehicle: Vehicle): [number, number] | null {
  const [low, high] = [toldBy(state, vehicle, "distance_low_m"),
    toldBy(state, vehicle, "distance_high_m")];
  if (!Number.isFinite(low) || !Number.isFinite(high)) return null;
  const ordered = vehicle.latest["safety/state"]?.message.framing?.distance_m ?? NaN;
  const farther = Number.isFinite(ordered) ? ordered - (low + high) / 2 : 0;
  return [Math.max(low, low + farther), Math.max(high + farther, low)];
}

/** Bearing of the person off the nose, left positive; null: not known. */
export function yawError_rad(odometry?: Odometry, target?: TargetState): number | null {
  if (!odometry || !target || target.status === Track.none) return null;
  const { position, orientation } = odometry.pose.pose;
  const bearing = Math.atan2(target.position_m[1]! - position.y,
    target.position_m[0]! - position.x);
  return wrap(bearing - yawOf(orientation));
}

/** Where it may fly, as its gate has it. null: no bound. */
export interface Bounds {
  fence_m: [number, number][];
  altitude_min_m: number | null;
  altitude_max_m: number | null;
}

const finite = (value: number | undefined): number | null =>
  value !== undefined && Number.isFinite(value) ? value : null;

/** null: a gate of an older release, which does not tell. */
export function boundsOf(safety: SafetyState | undefined): Bounds | null {
  if (!safety?.fence_m) return null;
  const at = Array.from(safety.fence_m);
  return {
    fence_m: Array.from({ length: at.length >> 1 }, (_, i) => [at[2 * i]!, at[2 * i + 1]!]),
    altitude_min_m: finite(safety.altitude_min_m), altitude_max_m: finite(safety.altitude_max_m),
  };
}

/** Where `return` leads; null: not known. */
export function homeOf(safety: SafetyState | undefined): Vec3 | null {
  return safety?.home_known && safety.home_m ? safety.home_m : null;
}

export function speed_mps(odometry: Odometry): number {
  const v = odometry.twist.twist.linear;
  return Math.hypot(v.x, v.y, v.z);
}

export function duration_s(plan: PlannedTrajectory): number {
  return plan.pieces.reduce((sum, piece) => sum + piece.duration_s, 0);
}

/** Recordings have ROS 2's form of the message, in which the rows follow each other. */
function coefficient({ coefficients }: TrajectoryPiece, power: number, axis: number): number {
  const row = coefficients[power]!;
  return typeof row === "number" ? (coefficients as ArrayLike<number>)[3 * power + axis]! : row[axis]!;
}

function at(piece: TrajectoryPiece, t: number, axis: number): number {
  let value = 0;
  for (let power = 5; power >= 0; power--)
    value = value * t + coefficient(piece, power, axis);
  return value;
}

/** count + 1 points, evenly in time from the start, as x, y, z triples. */
export function samplePlan(plan: PlannedTrajectory, count: number): [number, number, number][] {
  const points: [number, number, number][] = [];
  const total_s = duration_s(plan);
  let index = 0;
  let begin_s = 0;
  for (let i = 0; i <= count && plan.pieces.length > 0; i++) {
    const t = (total_s * i) / count;
    while (index + 1 < plan.pieces.length && t > begin_s + plan.pieces[index]!.duration_s)
      begin_s += plan.pieces[index++]!.duration_s;
    const piece = plan.pieces[index]!;
    const local_s = Math.min(t - begin_s, piece.duration_s);
    points.push([at(piece, local_s, 0), at(piece, local_s, 1), at(piece, local_s, 2)]);
  }
  return points;
}
