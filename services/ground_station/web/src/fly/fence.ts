// SPDX-License-Identifier: Apache-2.0
// A fence that is drawn: its corners on a map with north up, and whether it is one.

export type Corner = [number, number]; // east, north of the map's origin, m

export const most_corners = 32; // as the gate takes them

/** Of the drawing, in its pixels: where the origin lies, and how many pixels a metre has. */
export interface Map2d { x: number; y: number; scale: number }

export const toPixel = (map: Map2d, [east, north]: Corner): Corner =>
  [map.x + east * map.scale, map.y - north * map.scale];
export const toMetres = (map: Map2d, [x, y]: Corner): Corner =>
  [(x - map.x) / map.scale, (map.y - y) / map.scale];

/** So that all points are seen, and 20 m at least. */
export function mapAround(points: Corner[], width: number, height: number): Map2d {
  const all = points.length > 0 ? points : [[0, 0] as Corner];
  const [xs, ys] = [all.map((p) => p[0]), all.map((p) => p[1])];
  const span = (values: number[]): [number, number] => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    return [(low + high) / 2, Math.max(20, 1.3 * (high - low))];
  };
  const [[east, wide], [north, high]] = [span(xs), span(ys)];
  const scale = Math.min(width / wide, height / high);
  return { scale, x: width / 2 - east * scale, y: height / 2 + north * scale };
}

/** About the middle of the drawing. */
export function zoomed(map: Map2d, zoom: number, width: number, height: number): Map2d {
  const [x, y] = [width / 2, height / 2];
  return { scale: map.scale * zoom, x: x + zoom * (map.x - x), y: y + zoom * (map.y - y) };
}

/** Of the ruler: a round length that is seen well. */
export function scaleOf(map: Map2d): { metres: number; px: number } {
  const metres = [0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000]
    .find((m) => m * map.scale > 40) ?? 2000;
  return { metres, px: metres * map.scale };
}

const turn = ([ax, ay]: Corner, [bx, by]: Corner, [cx, cy]: Corner): number =>
  (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);

function cross(a: Corner, b: Corner, c: Corner, d: Corner): boolean {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

export function contains(fence: Corner[], [x, y]: Corner): boolean {
  let inside = false;
  fence.forEach(([ax, ay], i) => {
    const [bx, by] = fence[(i + 1) % fence.length]!;
    if (ay > y !== by > y && x < ax + ((y - ay) / (by - ay)) * (bx - ax)) inside = !inside;
  });
  return inside;
}

export type FenceFault = "" | "few" | "many" | "crossed" | "outside";

/** What the gate would refuse, or what would be of no use. vehicle: where it is. */
export function faultOf(fence: Corner[], vehicle: Corner | null): FenceFault {
  if (fence.length === 0) return "";
  if (fence.length < 3) return "few";
  if (fence.length > most_corners) return "many";
  for (let i = 0; i < fence.length; i++)
    for (let k = i + 1; k < fence.length; k++)
      if (cross(fence[i]!, fence[i + 1]!, fence[k]!, fence[(k + 1) % fence.length]!))
        return "crossed";
  return vehicle && !contains(fence, vehicle) ? "outside" : "";
}
