// SPDX-License-Identifier: Apache-2.0
// Where a person who was lost is believed to be: squares on the ground, larger where it is likelier;
// a ring at the likeliest place, and one where the vehicle goes to look.
import {
  DoubleSide, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial, PlaneGeometry, Quaternion,
  RingGeometry, Vector3,
} from "three";

import { blue, orange } from "../ui/palette.ts";
import type { Search } from "./sketch.ts";

export const maxCells = 2304;
const torso_m = 1.1; // about that high over the ground
const full = 255;

/** A square for each cell that holds belief; its area says how much. */
export function squaresOf({ x, y, z, cell_m, columns, belief }: Search): Matrix4[] {
  const squares: Matrix4[] = [];
  belief.forEach((share, i) => {
    if (share === 0 || squares.length === maxCells) return;
    const side_m = cell_m * Math.sqrt(share / full);
    squares.push(new Matrix4().compose(
      new Vector3(x + cell_m * (i % columns + 0.5), y + cell_m * (Math.floor(i / columns) + 0.5),
        z - torso_m),
      new Quaternion(), new Vector3(side_m, side_m, 1)));
  });
  return squares;
}

function ring(color: string): Mesh {
  return new Mesh(new RingGeometry(0.35, 0.5, 32), new MeshBasicMaterial({ color,
    transparent: true, opacity: 0.9, side: DoubleSide, depthWrite: false }));
}

export class Lost {
  readonly group = new Group();
  private readonly cells = new InstancedMesh(new PlaneGeometry(1, 1),
    new MeshBasicMaterial({ color: orange, transparent: true, opacity: 0.45, side: DoubleSide,
      depthWrite: false }), maxCells);
  private readonly likeliest = ring(orange);
  private readonly viewpoint = ring(blue);

  constructor() {
    this.cells.frustumCulled = false;
    this.group.add(this.cells, this.likeliest, this.viewpoint);
    this.set(null);
  }

  /** null: nobody is lost. */
  set(search: Search | null): void {
    this.group.visible = search !== null && search.mode > 0;
    if (!search || search.mode === 0) return;
    const squares = squaresOf(search);
    squares.forEach((square, i) => this.cells.setMatrixAt(i, square));
    this.cells.count = squares.length;
    this.cells.instanceMatrix.needsUpdate = true;
    this.likeliest.position.set(search.likeliest[0]!, search.likeliest[1]!, search.z - torso_m);
    this.viewpoint.visible = search.viewpoint !== null;
    if (search.viewpoint)
      this.viewpoint.position.set(search.viewpoint[0]!, search.viewpoint[1]!, search.z - torso_m);
  }
}
