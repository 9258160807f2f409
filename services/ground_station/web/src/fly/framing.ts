// SPDX-License-Identifier: Apache-2.0
// From where the person is to be seen: what can be set, what is set, and how it is said.
import type { TargetFraming } from "../data/messages.ts";
import { toldBy } from "../store/derive.ts";
import type { State, Vehicle } from "../store/state.ts";
import { said, t } from "../ui/words.ts";

/** As it is ordered. null: as the parameters have it; of the bearing: free. */
export interface Framing {
  distance_m: number | null;
  height_m: number | null;
  bearing_rad: number | null;
  circling_radps: number;
}

export type Range = readonly [number, number];
export interface Limits { distance_m: Range; height_m: Range; circling_radps: Range }

/** The safety gate refuses what is beyond; as its parameters are, unless it tells them. */
export const limits: Limits =
  { distance_m: [1.5, 10], height_m: [-0.5, 5], circling_radps: [-0.5, 0.5] };

export function limitsOf(state: State, vehicle: Vehicle | undefined): Limits {
  const told = (key: string, otherwise: number): number => {
    const value = vehicle ? toldBy(state, vehicle, key) : NaN;
    return Number.isFinite(value) ? value : otherwise;
  };
  const { distance_m, height_m, circling_radps } = limits;
  const most = told("framing_circling_max_rad_s", circling_radps[1]);
  return {
    distance_m: [told("framing_distance_min_m", distance_m[0]),
      told("framing_distance_max_m", distance_m[1])],
    height_m: [told("framing_height_min_m", height_m[0]),
      told("framing_height_max_m", height_m[1])],
    circling_radps: [-most, most],
  };
}

export const free: Framing =
  { distance_m: null, height_m: null, bearing_rad: null, circling_radps: 0 };

export const sides: [string, number | null][] = [[said("free"), null],
  [said("behind"), Math.PI], [said("ahead"), 0], [said("left"), Math.PI / 2],
  [said("right"), -Math.PI / 2]];

export const presets: [string, Framing][] = [
  [said("As the parameters say"), free],
  [said("Close behind"), { distance_m: 2, height_m: 0.3, bearing_rad: Math.PI, circling_radps: 0 }],
  [said("Far behind"), { distance_m: 5, height_m: 1.5, bearing_rad: Math.PI, circling_radps: 0 }],
  [said("Their face"), { distance_m: 3, height_m: 0.3, bearing_rad: 0, circling_radps: 0 }],
  [said("From the side"), { distance_m: 3, height_m: 0.5, bearing_rad: Math.PI / 2, circling_radps: 0 }],
  [said("Round them"), { distance_m: 4, height_m: 1, bearing_rad: null, circling_radps: 0.2 }],
];

const known = (value: number): number | null => (Number.isFinite(value) ? value : null);

/** What the gate says is set. */
export function framingOf(message: TargetFraming): Framing {
  return { distance_m: known(message.distance_m), height_m: known(message.height_m),
    bearing_rad: known(message.bearing_rad), circling_radps: known(message.circling_radps) ?? 0 };
}

const near = (a: number | null, b: number | null): boolean =>
  a === b || (a !== null && b !== null && Math.abs(a - b) < 1e-3);

export function same(a: Framing, b: Framing): boolean {
  return near(a.distance_m, b.distance_m) && near(a.height_m, b.height_m) &&
    near(a.circling_radps, b.circling_radps) && sideOf(a.bearing_rad) === sideOf(b.bearing_rad);
}

/** The nearest of the sides; −π is behind as π is. */
export function sideOf(bearing_rad: number | null): string {
  if (bearing_rad === null) return "free";
  const off = (side: number): number => 1 - Math.cos(bearing_rad - side);
  return sides.filter((side): side is [string, number] => side[1] !== null)
    .sort((a, b) => off(a[1]) - off(b[1]))[0]![0];
}

export function framingText(framing: Framing): string {
  if (same(framing, free)) return t("as the parameters say");
  const parts: string[] = [];
  if (framing.distance_m !== null) parts.push(`${framing.distance_m.toFixed(1)} m`);
  if (framing.height_m !== null)
    parts.push(t("{height} m above the torso", { height: framing.height_m.toFixed(1) }));
  if (framing.bearing_rad !== null) parts.push(t(sideOf(framing.bearing_rad)));
  if (framing.circling_radps !== 0)
    parts.push(t("{speed}°/s round them",
      { speed: ((framing.circling_radps * 180) / Math.PI).toFixed(0) }));
  return parts.join(", ");
}
