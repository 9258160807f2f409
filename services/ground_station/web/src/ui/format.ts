// SPDX-License-Identifier: Apache-2.0
// Numbers as an operator reads them.
import { t } from "./words.ts";

export function number(value: number | null | undefined, digits = 1, unit = ""): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const text = value.toFixed(digits);
  return (Number(text) === 0 ? text.replace("-", "") : text) + (unit && ` ${unit}`);
}

/** Negative: never. */
export function age(age_s: number): string {
  if (age_s < 0 || !Number.isFinite(age_s)) return t("never");
  if (age_s < 10) return `${age_s.toFixed(1)} s`;
  if (age_s < 120) return `${age_s.toFixed(0)} s`;
  return `${Math.floor(age_s / 60)} min`;
}

export function bytes(count: number): string {
  if (count < 1000) return `${count.toFixed(0)} B`;
  if (count < 1e6) return `${(count / 1e3).toFixed(1)} kB`;
  if (count < 1e9) return `${(count / 1e6).toFixed(1)} MB`;
  return `${(count / 1e9).toFixed(2)} GB`;
}

/** Time of day in UTC. */
export function timeOfDay(time_s: number, digits = 0): string {
  if (!Number.isFinite(time_s)) return "–";
  const iso = new Date(time_s * 1000).toISOString();
  return digits === 0 ? iso.slice(11, 19) : iso.slice(11, 20 + digits);
}

/** Minutes, seconds and tenths from the beginning. */
export function duration(span_s: number): string {
  const tenths = Math.round(Math.max(0, span_s) * 10);
  const minutes = Math.floor(tenths / 600);
  return `${minutes}:${((tenths % 600) / 10).toFixed(1).padStart(4, "0")}`;
}
