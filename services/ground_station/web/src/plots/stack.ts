// SPDX-License-Identifier: Apache-2.0
// All charts of one vehicle, one above the other.

import type uPlot from "uplot";

import { band_m } from "../store/derive.ts";
import type { Session } from "../ui/session.ts";
import type { Vehicle } from "../store/state.ts";
import { Chart, type ChartOptions, type Frame } from "./chart.ts";
import { frames } from "./frames.ts";
import { describe, drawLadder, ladderRows } from "./ladder.ts";
import { t } from "../ui/words.ts";

export const headerHeight = 18;
const atLeast = (floor: number, ceiling: number) => (low: number, high: number): [number, number] =>
  [Math.min(low, floor), Math.max(1.08 * high, ceiling)];

function shade(plot: uPlot, low: number, high: number): void {
  const { ctx, bbox } = plot;
  const top = plot.valToPos(high, "y", true);
  const bottom = plot.valToPos(low, "y", true);
  ctx.save();
  ctx.fillStyle = "rgba(47, 199, 155, 0.16)";
  ctx.strokeStyle = "rgba(47, 199, 155, 0.7)";
  ctx.setLineDash([4, 4]);
  ctx.fillRect(bbox.left, top, bbox.width, bottom - top);
  for (const y of [top, bottom]) {
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
  }
  ctx.restore();
}

export class ChartStack {
  private readonly charts: [string, Chart][];
  private observer: ResizeObserver;

  constructor(private readonly session: Session, private readonly host: HTMLElement) {
    const options = this.options();
    const names = Object.keys(options);
    this.charts = names.map((name, i) =>
      [name, new Chart(options[name]!, i === names.length - 1)]);
    host.replaceChildren(...this.charts.map(([, chart]) => chart.root));
    this.observer = new ResizeObserver(() => this.update());
    this.observer.observe(host);
  }

  update(): void {
    const { vehicle, state, span_s } = this.session;
    const { clientWidth: width, clientHeight: height } = this.host;
    if (!vehicle || width < 80 || height < 80) return;
    const weights = this.charts.reduce((sum, [, chart]) => sum + chart.options.weight, 0);
    const free = height - this.charts.length * headerHeight - 22;
    const from_s = state.now_s - span_s;
    this.charts.forEach(([name, chart], i) => {
      const share = Math.floor((free * chart.options.weight) / weights);
      const extra = i === this.charts.length - 1 ? 22 : 0;
      chart.update(this.frame(name, vehicle, from_s), from_s, state.now_s, width,
        Math.max(28, share) + extra);
    });
  }

  destroy(): void {
    this.observer.disconnect();
    this.charts.forEach(([, chart]) => chart.destroy());
  }

  private frame(name: string, vehicle: Vehicle, from_s: number): Frame {
    if (name !== "ladder") return frames[name]!(vehicle, from_s);
    return { times: [from_s, this.session.state.now_s], columns: [[null, null]],
      lines: [{ name: "states", color: "transparent" }],
      text: (time_s) => describe(vehicle, time_s) };
  }

  private options(): Record<string, ChartOptions> {
    const { session } = this;
    return {
      intention: { title: t("Intention"), unit: "", digits: 2, weight: 1.25, range: () => [0, 1] },
      distance: { title: t("Distance"), unit: "m", digits: 2, weight: 1, range: atLeast(0, 4),
        underlay: (plot) => {
          const band = session.vehicle && band_m(session.state, session.vehicle);
          if (band) shade(plot, ...band);
        } },
      speed: { title: t("Speed"), unit: "m/s", digits: 2, weight: 0.8, range: atLeast(0, 2) },
      yawError: { title: t("Yaw error"), unit: "°", digits: 1, weight: 0.8, range: (low, high) => {
        const most = Math.max(Math.abs(low), Math.abs(high));
        const bound = [20, 45, 90].find((b) => most < b) ?? 180;
        return [-bound, bound];
      }, steps: [20, 45, 90, 180] },
      planTime: { title: t("Plan time"), unit: "ms", digits: 1, weight: 1, range: atLeast(0, 2) },
      latency: { title: t("Image to setpoint"), unit: "ms", digits: 0, weight: 0.8,
        range: atLeast(0, 100) },
      ladder: { title: t("States"), unit: "", digits: 0, weight: 1.6, rows: ladderRows,
        range: () => [-0.5, ladderRows.length - 0.5],
        underlay: (plot) => session.vehicle && drawLadder(plot, session.vehicle) },
    };
  }
}
