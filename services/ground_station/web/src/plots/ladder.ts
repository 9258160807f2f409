// SPDX-License-Identifier: Apache-2.0
// The timeline of states: person, plan, mission, and the gate's ladder, with reasons.
import type uPlot from "uplot";

import type { Lane, Rung, Vehicle } from "../store/state.ts";
import { blue, grey, modeColors, orange, red, yellow } from "../ui/palette.ts";
import { said } from "../ui/words.ts";

const modes = ["track", "coast", "hover", "brake", "silent"];
export const ladderRows = [said("person"), said("plan"), said("mission"), ...modes];

const laneColors: Record<Lane, string[]> = {
  person: [grey, blue, yellow, red],
  plan: [grey, blue, yellow, orange, orange],
  mission: [grey, blue, yellow, orange, orange, red],
  gate: modeColors,
};

function rowOf(lane: Lane, rung: Rung): number {
  if (lane === "gate") return 3 + Math.min(rung.state, modes.length - 1);
  return ladderRows.indexOf(lane);
}

export function rungAt(rungs: Rung[], time_s: number | null): Rung | undefined {
  if (time_s === null) return rungs[rungs.length - 1];
  return rungs.findLast((rung) => rung.from_s <= time_s && time_s <= rung.to_s + 0.1);
}

/** "gate hover, plans have ceased to come · plan kept …" at a time, or now. */
export function describe(vehicle: Vehicle, time_s: number | null): string {
  const lanes: Lane[] = ["gate", "plan", "person", "mission"];
  return lanes.flatMap((lane) => {
    const rung = rungAt(vehicle.lanes[lane], time_s);
    return rung ? [`${lane} ${rung.word}${rung.why && `: ${rung.why}`}`] : [];
  }).join(" · ");
}

export function drawLadder(plot: uPlot, vehicle: Vehicle): void {
  const { ctx, bbox } = plot;
  const from_s = plot.scales["x"]!.min ?? 0;
  const height = bbox.height / ladderRows.length;
  ctx.save();
  ctx.beginPath();
  ctx.rect(bbox.left, bbox.top, bbox.width, bbox.height);
  ctx.clip();
  ctx.textBaseline = "middle";
  ctx.textAlign = "left";
  ctx.font = `${Math.min(11, Math.round(height * 0.8))}px system-ui, sans-serif`;
  for (const lane of Object.keys(vehicle.lanes) as Lane[])
    for (const rung of vehicle.lanes[lane])
      if (rung.to_s >= from_s) drawRung(plot, lane, rung, height);
  ctx.restore();
}

function drawRung(plot: uPlot, lane: Lane, rung: Rung, height: number): void {
  const { ctx, bbox } = plot;
  const left = plot.valToPos(rung.from_s, "x", true);
  const right = Math.max(plot.valToPos(rung.to_s, "x", true), left + 1);
  const top = bbox.top + rowOf(lane, rung) * height;
  ctx.fillStyle = laneColors[lane][rung.state] ?? grey;
  ctx.fillRect(left, top + 1, right - left, height - 2);
  const text = lane === "gate" ? rung.why : rung.why ? `${rung.word}: ${rung.why}` : rung.word;
  const begin = Math.max(left, bbox.left) + 4;
  if (text && ctx.measureText(text).width < right - begin - 4) {
    ctx.fillStyle = "#0b1015";
    ctx.fillText(text, begin, top + height / 2);
  }
}
