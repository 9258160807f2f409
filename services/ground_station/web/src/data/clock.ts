// SPDX-License-Identifier: Apache-2.0
// The time of a replay, as a pure function of wall time: no timers.

export interface ReplayClock {
  begin_s: number; // of the recording
  end_s: number;
  speed: number;
  playing: boolean;
  anchor_s: number; // log time at wall time wall_s
  wall_s: number;
}

export function makeClock(begin_s: number, end_s: number): ReplayClock {
  return { begin_s, end_s, speed: 1, playing: false, anchor_s: begin_s, wall_s: 0 };
}

export function timeAt(clock: ReplayClock, wall_s: number): number {
  const passed_s = clock.playing ? Math.max(0, wall_s - clock.wall_s) * clock.speed : 0;
  return clamp(clock.anchor_s + passed_s, clock.begin_s, clock.end_s);
}

export function hasEnded(clock: ReplayClock, wall_s: number): boolean {
  return clock.playing && timeAt(clock, wall_s) >= clock.end_s;
}

/** The same moment, from now on played or not; played from the end, it begins anew. */
export function play(clock: ReplayClock, playing: boolean, wall_s: number): ReplayClock {
  const now_s = timeAt(clock, wall_s);
  const anchor_s = playing && now_s >= clock.end_s ? clock.begin_s : now_s;
  return { ...clock, playing, anchor_s, wall_s };
}

export function seek(clock: ReplayClock, to_s: number, wall_s: number): ReplayClock {
  return { ...clock, anchor_s: clamp(to_s, clock.begin_s, clock.end_s), wall_s };
}

export function step(clock: ReplayClock, by_s: number, wall_s: number): ReplayClock {
  return { ...seek(clock, timeAt(clock, wall_s) + by_s, wall_s), playing: false };
}

export function setSpeed(clock: ReplayClock, speed: number, wall_s: number): ReplayClock {
  return { ...clock, anchor_s: timeAt(clock, wall_s), wall_s, speed };
}

/**
 * What an operator types: seconds from the start ("12.5", "+12.5"), minutes ("1:05.2"), or, with
 * two colons, a time of day in UTC ("14:03:22.5") on the recording's day. null: not a time.
 */
export function parseTime(text: string, clock: ReplayClock): number | null {
  const parts = text.trim().replace(/^\+/, "").split(":");
  if (parts.length > 3 || !parts.every((part) => /^\d+(\.\d+)?$/.test(part))) return null;
  const value = parts.reduce((sum, part) => 60 * sum + Number(part), 0);
  if (parts.length < 3) return clock.begin_s + value;
  const day_s = 86400 * Math.floor(clock.begin_s / 86400);
  const time_s = day_s + value;
  return time_s < clock.begin_s - 43200 ? time_s + 86400 : time_s; // after midnight
}

function clamp(value: number, low: number, high: number): number {
  return Math.min(Math.max(value, low), high);
}
