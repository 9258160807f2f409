// SPDX-License-Identifier: Apache-2.0
// The edges of convex polytopes, from their half-spaces.
import type { CorridorFace } from "../data/messages.ts";

type Point = [number, number, number];

/** Pairs of points. A polytope that is empty or open gives what edges it has. */
export function polytopeEdges(faces: CorridorFace[]): [Point, Point][] {
  const corners = cornersOf(faces);
  const edges: [Point, Point][] = [];
  for (let a = 0; a < faces.length; a++)
    for (let b = a + 1; b < faces.length; b++) {
      const on = corners.filter((c) => c.faces.has(a) && c.faces.has(b));
      const ends = farthest(on.map((c) => c.point));
      if (ends) edges.push(ends);
    }
  return edges;
}

interface Corner { point: Point; faces: Set<number> }

// Where three faces meet, inside of all others.
function cornersOf(faces: CorridorFace[]): Corner[] {
  const corners: Corner[] = [];
  const n = faces.length;
  for (let a = 0; a < n; a++)
    for (let b = a + 1; b < n; b++)
      for (let c = b + 1; c < n; c++) {
        const point = meet(faces[a]!, faces[b]!, faces[c]!);
        if (!point || !faces.every((face) => outside(face, point) < 1e-4)) continue;
        const on = faces.flatMap((face, i) => (Math.abs(outside(face, point)) < 1e-4 ? [i] : []));
        corners.push({ point, faces: new Set(on) });
      }
  return corners;
}

function outside(face: CorridorFace, p: Point): number {
  const { normal } = face;
  return normal[0]! * p[0] + normal[1]! * p[1] + normal[2]! * p[2] - face.offset_m;
}

// Cramer's rule.
function meet(a: CorridorFace, b: CorridorFace, c: CorridorFace): Point | null {
  const bc = cross(b.normal, c.normal);
  const det = a.normal[0]! * bc[0] + a.normal[1]! * bc[1] + a.normal[2]! * bc[2];
  if (Math.abs(det) < 1e-6) return null;
  const ca = cross(c.normal, a.normal);
  const ab = cross(a.normal, b.normal);
  const at = (i: number): number =>
    (a.offset_m * bc[i]! + b.offset_m * ca[i]! + c.offset_m * ab[i]!) / det;
  return [at(0), at(1), at(2)];
}

function cross(u: ArrayLike<number>, v: ArrayLike<number>): Point {
  return [u[1]! * v[2]! - u[2]! * v[1]!, u[2]! * v[0]! - u[0]! * v[2]!,
    u[0]! * v[1]! - u[1]! * v[0]!];
}

function farthest(points: Point[]): [Point, Point] | null {
  let best: [Point, Point] | null = null;
  let most = 1e-3;
  for (const p of points)
    for (const q of points) {
      const d = Math.hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
      if (d > most) {
        most = d;
        best = [p, q];
      }
    }
  return best;
}
