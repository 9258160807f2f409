// SPDX-License-Identifier: Apache-2.0
// A picture with its overlay, on any canvas.
import type { Box, Overlay } from "./overlay.ts";
import type { Pixel } from "./project.ts";

/** Where on the canvas the picture lies. */
export interface Place { x: number; y: number; scale: number }

const chosen = "#f0c04a";
const other = "#56b4e9";
const planColor = "#f4f7fa";
const under = "#0b1015";

/** As large as it fits, in the middle. */
export function placeIn(width: number, height: number, of: { width: number; height: number }): Place {
  const scale = Math.min(width / of.width, height / of.height);
  return { x: (width - scale * of.width) / 2, y: (height - scale * of.height) / 2, scale };
}

class Pen {
  constructor(private readonly context: CanvasRenderingContext2D, readonly place: Place,
              readonly unit: number) {}

  private go([x, y]: Pixel, first: boolean): void {
    const { place, context } = this;
    const [u, v] = [place.x + x * place.scale, place.y + y * place.scale];
    if (first) context.moveTo(u, v);
    else context.lineTo(u, v);
  }

  /** With a dark edge, so that it is seen on any ground. */
  line(pieces: Pixel[][], color: string, width: number, alpha = 1, dash: number[] = []): void {
    const { context, unit } = this;
    context.beginPath();
    for (const piece of pieces) piece.forEach((pixel, i) => this.go(pixel, i === 0));
    context.lineJoin = "round";
    context.lineCap = dash.length > 0 ? "butt" : "round";
    context.setLineDash(dash.map((d) => d * unit));
    for (const [stroke, wide] of [[under, width + 2], [color, width]] as const) {
      context.globalAlpha = stroke === under ? 0.55 * alpha : alpha;
      context.strokeStyle = stroke;
      context.lineWidth = wide * unit;
      context.stroke();
    }
    context.globalAlpha = 1;
    context.setLineDash([]);
  }

  label(text: string, x: number, y: number, color: string): void {
    const { context, unit, place } = this;
    context.font = `600 ${12 * unit}px system-ui, sans-serif`;
    const width = context.measureText(text).width + 8 * unit;
    const u = place.x + x * place.scale;
    const v = Math.max(place.y + 17 * unit, place.y + y * place.scale);
    context.fillStyle = `${under}cc`;
    context.fillRect(u, v - 17 * unit, width, 17 * unit);
    context.fillStyle = color;
    context.fillText(text, u + 4 * unit, v - 4.5 * unit);
  }
}

function drawBox(pen: Pen, box: Box): void {
  const { left, top, right, bottom, followed, seen, id, distance_m } = box;
  const ring: Pixel[] = [[left, top], [right, top], [right, bottom], [left, bottom], [left, top]];
  const color = followed ? chosen : other;
  pen.line([ring], color, followed ? 3 : 1.5, 1, seen ? [] : [5, 4]);
  const far = distance_m === null ? "" : ` ${distance_m.toFixed(1)} m`;
  pen.label(`${followed ? "◉ " : ""}${id}${far}`, left, top, color);
}

/** unit: canvas pixels to a pixel of the page. */
export function draw(context: CanvasRenderingContext2D, picture: CanvasImageSource,
                     overlay: Overlay | null, place: Place, unit: number,
                     size: { width: number; height: number }): void {
  const { canvas } = context;
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.drawImage(picture, place.x, place.y, size.width * place.scale, size.height * place.scale);
  if (!overlay) return;
  context.save();
  context.beginPath();
  context.rect(place.x, place.y, size.width * place.scale, size.height * place.scale);
  context.clip();
  const pen = new Pen(context, place, unit);
  for (const { color, share, pieces } of overlay.ways)
    pen.line(pieces, color, 1.5 + 3 * share, 0.35 + 0.65 * share);
  pen.line(overlay.plan, planColor, 1.5, 0.9);
  pen.line(overlay.bones, "#cfe8f7", 1.2, 0.8);
  overlay.boxes.filter((b) => !b.followed).forEach((b) => drawBox(pen, b));
  overlay.boxes.filter((b) => b.followed).forEach((b) => drawBox(pen, b));
  context.restore();
}
