// SPDX-License-Identifier: Apache-2.0
// Occupied cells as they are drawn: all boxes in one mesh. Software draws each instance as if it
// were a mesh of its own, which takes twice as long.
import {
  BoxGeometry, BufferAttribute, BufferGeometry, Color, Mesh, MeshBasicMaterial,
} from "three";

import { type Block, blocks, type Voxels } from "./voxels.ts";

const ground_m = 0.3; // what is no higher is the ground, and would hide what is drawn on it
const maxBlocks = 12000;
const box = new BoxGeometry(1, 1, 1);
const corners = box.getAttribute("position");
const order = box.getIndex()!;
// Faces are lit by their direction and height alone: as cheap as can be.
const light = [0.9, 0.85, 0.8, 0.95, 1, 0.66]; // +x −x +y −y +z −z
const foot = 0.76;

export function wallGeometry(found: readonly Block[]): BufferGeometry {
  const positions = new Float32Array(3 * corners.count * found.length);
  const colors = new Float32Array(positions.length);
  const index = new Uint32Array(order.count * found.length);
  const color = new Color();
  found.forEach(({ x0, x1, y0, y1, z0, z1 }, n) => {
    const height = Math.min(1, Math.max(0, z1 / 4)); // cool and dark below, pale above
    color.setHSL(0.58, 0.14, 0.53 + 0.24 * height);
    const first = n * corners.count;
    for (let corner = 0; corner < corners.count; corner++) {
      const isLow = corners.getZ(corner) < 0;
      const shade = light[corner >> 2]! * (isLow ? foot : 1);
      const at = 3 * (first + corner);
      positions[at] = corners.getX(corner) < 0 ? x0 : x1;
      positions[at + 1] = corners.getY(corner) < 0 ? y0 : y1;
      positions[at + 2] = isLow ? z0 : z1;
      color.toArray(colors, at);
      for (let i = at; i < at + 3; i++) colors[i]! *= shade;
    }
    for (let i = 0; i < order.count; i++) index[n * order.count + i] = first + order.getX(i);
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(positions, 3));
  geometry.setAttribute("color", new BufferAttribute(colors, 3));
  geometry.setIndex(new BufferAttribute(index, 1));
  geometry.computeBoundingSphere();
  return geometry;
}

export class Walls {
  readonly mesh = new Mesh(new BufferGeometry(), new MeshBasicMaterial({ vertexColors: true }));

  constructor() {
    this.mesh.visible = false;
  }

  /** What stands higher than cut_m is cut off there, so that one looks into rooms and streets. */
  set(voxels: Voxels, cut_m: number): void {
    const found = blocks(voxels, ground_m, cut_m).slice(0, maxBlocks);
    this.mesh.geometry.dispose();
    this.mesh.geometry = wallGeometry(found);
    this.mesh.visible = found.length > 0;
  }
}
