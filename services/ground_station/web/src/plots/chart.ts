// SPDX-License-Identifier: Apache-2.0
// One uPlot chart of the stack: a header with the values at the cursor, a time axis shared by all.
import uPlot from "uplot";

import { grey } from "../ui/palette.ts";
import { timeOfDay } from "../ui/format.ts";

export interface Line { name: string; color: string; fill?: boolean; dash?: number[] }

export interface Frame {
  times: number[];
  columns: (number | null)[][];
  lines: Line[];
  /** What the header says of a row, if not its columns' values. */
  text?: (time_s: number | null) => string;
  values?: (number | null)[][]; // what the header tells of, where the columns are sums
}

export interface ChartOptions {
  title: string;
  unit: string;
  digits: number;
  range: (low: number, high: number) => [number, number];
  underlay?: (plot: uPlot) => void; // drawn below the lines
  steps?: number[]; // between lines of the grid
  rows?: string[]; // names of rows 0, 1, … instead of numbers
  weight: number; // of the height
}

const axisColor = "#9fb0c0";
const gridColor = "#26313d";
const halfLabel_px = 22; // of a time; it must not be cut off
const font = "11px system-ui, sans-serif";

// Not asked of the document, which would have to be laid out for it.
const widthOf = ({ bbox }: uPlot): number => bbox.width / devicePixelRatio;

export class Chart {
  readonly root = document.createElement("section");
  private readonly title = document.createElement("b");
  private readonly values = document.createElement("span");
  private readonly body = document.createElement("div");
  private plot: uPlot | null = null;
  private linesKey = "";
  private frame: Frame | null = null;

  constructor(readonly options: ChartOptions, private readonly last: boolean) {
    this.root.className = "chart";
    this.root.dataset["chart"] = options.title;
    const header = document.createElement("header");
    this.title.textContent = options.title;
    this.values.className = "values";
    header.append(this.title, this.values);
    this.root.append(header, this.body);
  }

  update(frame: Frame, from_s: number, to_s: number, width: number, height: number): void {
    this.frame = frame;
    const key = frame.lines.map((line) => line.name).join("\n");
    if (!this.plot || key !== this.linesKey) this.make(frame, key, width, height);
    const plot = this.plot!;
    if (plot.width !== width || plot.height !== height) plot.setSize({ width, height });
    plot.batch(() => {
      plot.setData([frame.times, ...frame.columns] as uPlot.AlignedData, false);
      plot.setScale("x", { min: from_s, max: to_s });
    });
    this.tell(plot);
  }

  destroy(): void {
    this.plot?.destroy();
  }

  private make(frame: Frame, key: string, width: number, height: number): void {
    this.plot?.destroy();
    this.linesKey = key;
    this.makeValues(frame);
    const { options } = this;
    this.plot = new uPlot({
      width, height,
      legend: { show: false },
      padding: [6, 8, this.last ? 0 : 6, 0],
      cursor: { sync: { key: "time", setSeries: false }, drag: { x: false, y: false },
        points: { size: 5 } },
      scales: {
        x: { time: false },
        y: { dir: options.rows ? -1 : 1,
          range: (_u, low, high) => options.range(low ?? 0, high ?? 1) },
      },
      axes: [this.timeAxis(), this.valueAxis()],
      series: [{}, ...frame.lines.map((line) => ({
        label: line.name, stroke: line.color, width: 1.5, spanGaps: false,
        points: { show: false },
        ...(line.fill ? { fill: line.color } : {}), ...(line.dash ? { dash: line.dash } : {}),
      }))],
      hooks: {
        drawAxes: [(u) => options.underlay?.(u)],
        setCursor: [(u) => this.tell(u)],
      },
    }, [frame.times, ...frame.columns] as uPlot.AlignedData, this.body);
  }

  private timeAxis(): uPlot.Axis {
    return { show: true, size: this.last ? 22 : 0, stroke: axisColor, font, space: 70,
      grid: { stroke: gridColor, width: 1 }, ticks: { show: false },
      incrs: [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 3600, 86400],
      values: (u, splits) => splits.map((s) =>
        this.last && u.valToPos(s, "x") < widthOf(u) - halfLabel_px ? timeOfDay(s) : "") };
  }

  private valueAxis(): uPlot.Axis {
    const { rows, steps } = this.options;
    const base: uPlot.Axis = { size: 52, stroke: axisColor, font, space: 18,
      grid: { stroke: gridColor, width: 1 }, ticks: { show: false },
      ...(steps ? { incrs: steps } : {}) };
    if (!rows) return base;
    return { ...base, grid: { show: false }, splits: () => rows.map((_, i) => i),
      values: () => rows };
  }

  // The values at the cursor, or else the newest ones.
  private tell(plot: uPlot): void {
    const { frame, options } = this;
    if (!frame) return;
    const at = plot.cursor.idx ?? null;
    const inside = (plot.cursor.left ?? -1) >= 0;
    const row = inside && at !== null ? at : frame.times.length - 1;
    const time_s = inside ? plot.posToVal(plot.cursor.left!, "x") : null;
    const words = frame.text ? [frame.text(time_s)] : frame.lines.map(({ name }, i) => {
      const value = (frame.values ?? frame.columns)[i]?.[row];
      const known = value !== null && value !== undefined;
      return `${frame.lines.length > 1 ? `${name} ` : ""}` +
        `${known ? value.toFixed(options.digits) : "–"} ${options.unit}`.trimEnd();
    });
    this.values.querySelectorAll("span").forEach((span, i) => {
      if (span.textContent !== words[i]) span.textContent = words[i] ?? "";
    });
  }

  // What the header tells is written into these.
  private makeValues({ lines, text }: Frame): void {
    this.values.replaceChildren(...lines.flatMap((line) => {
      const chip = document.createElement("i");
      chip.style.background = line.color;
      const span = document.createElement("span");
      span.dataset["line"] = line.name;
      return text ? [span] : [chip, span];
    }));
  }
}

export const neutral = grey;
