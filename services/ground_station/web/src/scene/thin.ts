// SPDX-License-Identifier: Apache-2.0
// A line of few points that looks the same.
interface At { x: number; y: number; z: number }

const tolerance_m = 0.02;
const longest_m = 1.5; // as it fades along its points

/** Leaves out what lies on the way from one point to the next that is kept. */
export function thin<T extends At>(points: readonly T[]): T[] {
  const kept: T[] = [];
  let left: T[] = []; // out, since the last one that was kept
  for (const point of points) {
    const from = kept.at(-1);
    if (from && left.length > 0 && !isStraight(from, left, point)) {
      kept.push(left.at(-1)!);
      left = [];
    }
    if (kept.length === 0) kept.push(point);
    else left.push(point);
  }
  if (left.length > 0) kept.push(left.at(-1)!);
  return kept;
}

function isStraight(from: At, between: readonly At[], to: At): boolean {
  const [dx, dy, dz] = [to.x - from.x, to.y - from.y, to.z - from.z];
  const length_m = Math.hypot(dx, dy, dz);
  if (length_m > longest_m) return false;
  return between.every((p) => {
    const [x, y, z] = [p.x - from.x, p.y - from.y, p.z - from.z];
    const share = length_m > 0 ? (x * dx + y * dy + z * dz) / length_m ** 2 : 0;
    if (share < 0 || share > 1) return false; // it turned back
    return Math.hypot(x - share * dx, y - share * dy, z - share * dz) < tolerance_m;
  });
}
