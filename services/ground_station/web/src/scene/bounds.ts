// SPDX-License-Identifier: Apache-2.0
// The fence as a cage of lines from its lower altitude to its upper one, and where `return` leads.
import { Group } from "three";

import { yellow } from "../ui/palette.ts";
import { type Point, Segments } from "./shapes.ts";
import type { Limits } from "./sketch.ts";

const ground_m = 0.04;
const openTop_m = 3; // of its posts, where no altitude ends them
const pad_m = 0.6; // of the return place's sign

type Edge = readonly [Point, Point];

export function fenceEdges({ fence, low_m, high_m }: Limits): Edge[] {
  const corners = Array.from({ length: fence.length / 2 }, (_, i) =>
    [fence[2 * i]!, fence[2 * i + 1]!] as const);
  const low = low_m ?? ground_m;
  const rings = high_m === null ? [ground_m] : [ground_m, low, high_m];
  const sides = corners.flatMap(([x, y], i): Edge[] => {
    const [u, v] = corners[(i + 1) % corners.length]!;
    return rings.map((z): Edge => [[x, y, z], [u, v, z]]);
  });
  return [...sides, ...corners.map(([x, y]): Edge => [[x, y, low], [x, y, high_m ?? openTop_m]])];
}

/** An H in a square, on the ground, with north up. */
export function homeEdges({ home }: Limits): Edge[] {
  if (!home) return [];
  const at = (x: number, y: number): Point => [home[0]! + pad_m * x, home[1]! + pad_m * y, ground_m];
  const lines = [[-1, -1, 1, -1], [1, -1, 1, 1], [1, 1, -1, 1], [-1, 1, -1, -1],
    [-0.4, -0.6, -0.4, 0.6], [0.4, -0.6, 0.4, 0.6], [-0.4, 0, 0.4, 0]] as const;
  return lines.map(([x, y, u, v]): Edge => [at(x, y), at(u, v)]);
}

export class BoundsView {
  readonly group = new Group();
  private readonly fence = new Segments(160, yellow, 0.8);
  private readonly home = new Segments(7, "#f4f7fa", 0.9);
  private drawn = "";

  constructor() {
    this.group.add(this.fence.mesh, this.home.mesh);
  }

  set(limits: Limits): void {
    const { fence, low_m, high_m, home } = limits;
    const key = [...fence, low_m, high_m, ...Array.from(home ?? [])].join();
    if (key === this.drawn) return;
    this.drawn = key;
    this.fence.set(fenceEdges(limits));
    this.home.set(homeEdges(limits));
  }
}
