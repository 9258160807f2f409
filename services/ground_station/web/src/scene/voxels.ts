// Occupied cells: read from either map topic, drawn as instanced boxes.
import {
  BoxGeometry, BufferAttribute, Color, DynamicDrawUsage, InstancedMesh, MeshBasicMaterial, Object3D,
} from "three";

import type { LocalMap, PointCloud2 } from "../data/messages.ts";

export interface Voxels { resolution_m: number; centers: Float32Array } // x, y, z triples

const occupied = 1;
const ground_m = 0.3; // what is no higher is the ground, and would hide what is drawn on it
const maxColumns = 12000;

export function voxelsOfMap(map: LocalMap): Voxels {
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
export function voxelsOfPoints(cloud: PointCloud2): Voxels {
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

/** A stretch of occupied cells, one above the other. */
export interface Column { x: number; y: number; low_m: number; high_m: number }

/** Cells that stand on each other as one box: what stands in a room is mostly upright. */
export function columns({ centers, resolution_m: r }: Voxels): Column[] {
  const cell = (value: number): number => Math.floor(value / r + 1e-3);
  const stacks = new Map<number, { x: number; y: number; levels: number[] }>();
  for (let n = 0; n < centers.length; n += 3) {
    const [x, y] = [centers[n]!, centers[n + 1]!];
    const key = cell(x) + 65536 * cell(y);
    const stack = stacks.get(key) ?? { x, y, levels: [] };
    stack.levels.push(cell(centers[n + 2]!));
    stacks.set(key, stack);
  }
  const found: Column[] = [];
  for (const { x, y, levels } of stacks.values()) {
    levels.sort((a, b) => a - b);
    levels.forEach((level, i) => {
      const last = i > 0 ? found[found.length - 1]! : undefined;
      if (last && level - levels[i - 1]! <= 1) last.high_m = (level + 1) * r;
      else found.push({ x, y, low_m: level * r, high_m: (level + 1) * r });
    });
  }
  return found;
}

// Faces are lit by their direction and height alone: as cheap as can be.
function litBox(): BoxGeometry {
  const box = new BoxGeometry(1, 1, 1);
  const light = [0.8, 0.7, 0.62, 0.9, 1, 0.4]; // +x −x +y −y +z −z
  const heights = box.getAttribute("position");
  const colors = new Float32Array(24 * 3);
  for (let vertex = 0; vertex < 24; vertex++) {
    const shade = heights.getZ(vertex) < 0 ? 0.55 : 1;
    colors.fill(light[vertex >> 2]! * shade, 3 * vertex, 3 * vertex + 3);
  }
  box.setAttribute("color", new BufferAttribute(colors, 3));
  return box;
}

export class VoxelView {
  readonly mesh = new InstancedMesh(litBox(), new MeshBasicMaterial({ vertexColors: true }),
    maxColumns);

  constructor() {
    this.mesh.instanceMatrix.setUsage(DynamicDrawUsage);
    this.mesh.setColorAt(0, new Color(1, 1, 1));
    this.mesh.frustumCulled = false;
    this.mesh.count = 0;
  }

  set(voxels: Voxels): void {
    const found = columns(voxels).filter((c) => c.high_m > ground_m).slice(0, maxColumns);
    const width_m = 0.96 * voxels.resolution_m;
    const place = new Object3D();
    const color = new Color();
    found.forEach(({ x, y, low_m, high_m }, n) => {
      place.position.set(x, y, (low_m + high_m) / 2);
      place.scale.set(width_m, width_m, high_m - low_m);
      place.updateMatrix();
      this.mesh.setMatrixAt(n, place.matrix);
      const height = Math.min(1, Math.max(0, high_m / 4)); // cool and dark below, pale above
      this.mesh.setColorAt(n, color.setHSL(0.58, 0.22, 0.24 + 0.3 * height));
    });
    this.mesh.count = found.length;
    this.mesh.instanceMatrix.needsUpdate = true;
    this.mesh.instanceColor!.needsUpdate = true;
  }
}
