// SPDX-License-Identifier: Apache-2.0
// Columns of values over time for the plots, bounded in length and rate.

export type Value = number | null;

export class Series {
  times: number[] = [];
  columns: Value[][] = [];

  /** Rows nearer than period_s to the last one replace nothing and are dropped. */
  constructor(public names: string[], private readonly period_s = 0.04,
              private readonly keep_s = 150) {
    this.columns = names.map(() => []);
  }

  push(time_s: number, values: Value[]): void {
    const last_s = this.times[this.times.length - 1] ?? -Infinity;
    if (time_s < last_s + this.period_s) return;
    if (time_s - last_s > 1 && this.times.length > 0) this.append(last_s + 1e-3, []); // a gap
    this.append(time_s, values);
    this.trim(time_s);
  }

  /** Columns are made as their names come up. */
  pushNamed(time_s: number, values: Map<string, number>): void {
    for (const name of values.keys())
      if (!this.names.includes(name)) {
        this.names = [...this.names, name];
        this.columns.push(this.times.map(() => null));
      }
    this.push(time_s, this.names.map((name) => values.get(name) ?? null));
  }

  newest(column = 0): Value {
    const values = this.columns[column];
    return values?.[values.length - 1] ?? null;
  }

  private append(time_s: number, values: Value[]): void {
    this.times.push(time_s);
    this.columns.forEach((column, i) => column.push(values[i] ?? null));
  }

  // Seldom, so that it costs nothing a row.
  private trim(now_s: number): void {
    if (now_s - this.times[0]! < 1.5 * this.keep_s) return;
    const from = this.times.findIndex((t) => t > now_s - this.keep_s);
    this.times = this.times.slice(from);
    this.columns = this.columns.map((column) => column.slice(from));
  }
}

export interface TrailPoint { time_s: number; x: number; y: number; z: number }

/** Where something has been, one point every min_m, for keep_s. */
export class Trail {
  points: TrailPoint[] = [];
  version = 0;
  constructor(private readonly min_m = 0.1, private readonly keep_s = 90,
              private readonly jump_m = 5) {}

  push(time_s: number, x: number, y: number, z: number): void {
    if (![x, y, z].every(Number.isFinite)) return;
    const last = this.points[this.points.length - 1];
    const step_m = last ? Math.hypot(x - last.x, y - last.y, z - last.z) : Infinity;
    if (last && step_m > this.jump_m) this.points = []; // put elsewhere
    if (step_m < this.min_m) return;
    this.points.push({ time_s, x, y, z });
    this.version++;
    const old = this.points.findIndex((p) => p.time_s > time_s - this.keep_s);
    if (old > 32) this.points = this.points.slice(old);
  }
}
