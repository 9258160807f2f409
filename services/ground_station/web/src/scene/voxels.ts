// SPDX-License-Identifier: Apache-2.0
// Occupied cells: read from either map topic, and joined to few boxes.
import type { LocalMap, PointCloud2 } from "../data/messages.ts";

export interface Voxels { resolution_m: number; centers: Float32Array } // x, y, z triples

const occupied = 1;

export function voxelsOfMap(map: Omit<LocalMap, "header">): Voxels {
  const { resolution_m, origin_m, size_x, size_y, size_z, cells } = map;
  const centers: number[] = [];
  let n = 0;
  for (let k = 0; k < size_z; k++)
    for (let j = 0; j < size_y; j++)
      for (let i = 0; i < size_x; i++)
        if (cells[n++] === occupied)
          centers.push(origin_m[0]! + (i + 0.5) * resolution_m,
            origin_m[1]! + (j + 0.5) * resolution_m, origin_m[2]! + (k + 0.5) * resolution_m);
  return { resolution_m, centers: Float32Array.from(centers) };
}

/** The resolution is the smallest step along x from one point to the next. */
export function voxelsOfPoints(cloud: Omit<PointCloud2, "header">): Voxels {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const count = Math.min(cloud.width * cloud.height,
    Math.floor(cloud.data.byteLength / Math.max(1, cloud.point_step)));
  const offsets = ["x", "y", "z"].map((name) => cloud.fields.find((f) => f.name === name)?.offset);
  const centers = new Float32Array(3 * count);
  let step = Infinity;
  for (let n = 0; n < count; n++) {
    for (let axis = 0; axis < 3; axis++)
      centers[3 * n + axis] = view.getFloat32(n * cloud.point_step + (offsets[axis] ?? 0), true);
    const dx = n > 0 ? Math.abs(centers[3 * n]! - centers[3 * n - 3]!) : 0;
    if (dx > 0.01 && dx < step) step = dx;
  }
  return { resolution_m: Number.isFinite(step) ? Math.min(step, 1) : 0.15, centers };
}

/** A box of occupied cells, by its corners. */
export interface Block {
  x0: number; x1: number; y0: number; y1: number; z0: number; z1: number;
}

/**
 * The same cells as few boxes: first upright, as what stands in a room mostly is, then along x,
 * then along y. Below floor_m is the ground; what is above ceiling_m is cut off.
 */
export function blocks(voxels: Voxels, floor_m = -Infinity, ceiling_m = Infinity): Block[] {
  const r = voxels.resolution_m;
  const upright = columns(voxels).filter((b) => b.z1 * r > floor_m && b.z0 * r < ceiling_m)
    .map((b) => ({ ...b, z1: Math.min(b.z1, Math.ceil(ceiling_m / r)) }));
  const along = (b: Block): string => `${b.y0} ${b.z0} ${b.z1}`;
  const rows = merge(upright.sort((a, b) => a.y0 - b.y0 || a.x0 - b.x0), along, "x0", "x1");
  const across = (b: Block): string => `${b.x0} ${b.x1} ${b.z0} ${b.z1}`;
  const merged = merge(rows.sort((a, b) => a.y0 - b.y0), across, "y0", "y1");
  return merged.map((b) => ({ x0: b.x0 * r, x1: b.x1 * r, y0: b.y0 * r, y1: b.y1 * r,
    z0: b.z0 * r, z1: Math.min(b.z1 * r, ceiling_m) }));
}

// In whole cells.
function columns({ centers, resolution_m: r }: Voxels): Block[] {
  const cell = (value: number): number => Math.floor(value / r + 1e-3);
  const stacks = new Map<number, number[]>(); // levels by place
  for (let n = 0; n < centers.length; n += 3) {
    const key = cell(centers[n]!) + 32768 + 65536 * (cell(centers[n + 1]!) + 32768);
    const levels = stacks.get(key);
    if (levels) levels.push(cell(centers[n + 2]!));
    else stacks.set(key, [cell(centers[n + 2]!)]);
  }
  const found: Block[] = [];
  for (const [key, levels] of stacks) {
    const [x0, y0] = [(key % 65536) - 32768, Math.floor(key / 65536) - 32768];
    levels.sort((a, b) => a - b);
    levels.forEach((level, i) => {
      if (i > 0 && level - levels[i - 1]! <= 1) found[found.length - 1]!.z1 = level + 1;
      else found.push({ x0, x1: x0 + 1, y0, y1: y0 + 1, z0: level, z1: level + 1 });
    });
  }
  return found;
}

// Joins boxes of one kind that touch: the end of one is the begin of the next. Sorted by begin.
function merge(boxes: Block[], kind: (b: Block) => string, begin: "x0" | "y0",
               end: "x1" | "y1"): Block[] {
  const open = new Map<string, Block>();
  const merged: Block[] = [];
  for (const box of boxes) {
    const before = open.get(kind(box));
    if (before && before[end] === box[begin]) {
      before[end] = box[end];
      continue;
    }
    const own = { ...box };
    open.set(kind(box), own);
    merged.push(own);
  }
  return merged;
}
