// SPDX-License-Identifier: Apache-2.0
// Lines on the ground, a metre apart near by and three metres farther off.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from "three";

const [near_m, far_m] = [12, 30];
/** Where the grid's middle may be. Software drops a line that reaches behind the camera: pieces. */
export const gridStep_m = 3;

export function groundGrid(): LineSegments {
  const points: number[] = [];
  for (let side = -far_m; side <= far_m; side++)
    for (let from = -far_m; from < far_m; from += gridStep_m) {
      const isNear = Math.abs(side) <= near_m && from >= -near_m && from < near_m;
      if (isNear || side % gridStep_m === 0)
        points.push(side, from, 0, side, from + gridStep_m, 0,
          from, side, 0, from + gridStep_m, side, 0);
    }
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: "#2c3945" }));
}
