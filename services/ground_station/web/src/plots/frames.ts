// SPDX-License-Identifier: Apache-2.0
// From the store's series to what each chart draws.
import type { Series } from "../store/series.ts";
import type { Vehicle } from "../store/state.ts";
import { blue, colorOf, green, grey, orange, spoken } from "../ui/palette.ts";
import type { Frame, Line } from "./chart.ts";

type Columns = (number | null)[][];

/** The rows from from_s on, and one before it. */
export function rowsFrom(series: Series, from_s: number): { times: number[]; columns: Columns } {
  let low = 0;
  let high = series.times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (series.times[middle]! < from_s) low = middle + 1;
    else high = middle;
  }
  const from = Math.max(0, low - 1);
  return { times: series.times.slice(from), columns: series.columns.map((c) => c.slice(from)) };
}

/** Each column on top of those before it. */
export function stacked(columns: Columns): Columns {
  const sums: Columns = [];
  columns.forEach((column, i) => {
    const below = sums[i - 1];
    sums.push(column.map((value, row) =>
      value === null && (below?.[row] ?? null) === null
        ? null : (below?.[row] ?? 0) + (value ?? 0)));
  });
  return sums;
}

// The highest sum is drawn first and each filled down to zero, so that the lower ones cover it.
function stackOf(series: Series, from_s: number,
                 color: (name: string, i: number) => string): Frame {
  const { times, columns } = rowsFrom(series, from_s);
  const lines = series.names.map((name, i): Line =>
    ({ name: spoken(name), color: color(name, i), fill: true }));
  return { times, columns: stacked(columns).reverse(), values: [...columns].reverse(),
    lines: lines.reverse() };
}

function linesOf(series: Series, from_s: number, lines: Line[]): Frame {
  return { ...rowsFrom(series, from_s), lines };
}

export const frames: Record<string, (vehicle: Vehicle, from_s: number) => Frame> = {
  intention: (v, from_s) =>
    stackOf(v.intention, from_s, (name) => v.intentionColors.get(name) ?? grey),
  distance: (v, from_s) => linesOf(v.distance, from_s, [{ name: "distance", color: blue }]),
  speed: (v, from_s) => linesOf(v.speed, from_s,
    [{ name: "vehicle", color: blue }, { name: "person", color: orange, dash: [5, 3] }]),
  yawError: (v, from_s) => linesOf(v.yawError, from_s, [{ name: "yaw error", color: green }]),
  planTime: (v, from_s) => stackOf(v.planTime, from_s, (_name, i) => colorOf(i)),
  latency: (v, from_s) => linesOf(v.latency, from_s, [{ name: "latency", color: orange }]),
};
