// Lines on the ground, a metre apart.
import { BufferGeometry, Float32BufferAttribute, LineBasicMaterial, LineSegments } from "three";

const reach_m = 30;
// Graphics in software drop a line that reaches behind the camera, so each is many.
const piece_m = 3;

export function groundGrid(): LineSegments {
  const points: number[] = [];
  for (let side = -reach_m; side <= reach_m; side++)
    for (let from = -reach_m; from < reach_m; from += piece_m)
      points.push(side, from, 0, side, from + piece_m, 0, from, side, 0, from + piece_m, side, 0);
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(points, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: "#2c3945" }));
}
