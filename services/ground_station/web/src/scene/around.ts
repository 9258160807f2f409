// SPDX-License-Identifier: Apache-2.0
// Who and what moves around a vehicle: cylinders, and where each is expected. The followed person
// stands in a ring.
import {
  Color, CylinderGeometry, DoubleSide, Group, InstancedMesh, Matrix4, Mesh, MeshBasicMaterial,
  MeshLambertMaterial, Quaternion, RingGeometry, Vector3,
} from "three";

import { orange, yellow } from "../ui/palette.ts";
import { type Point, Ribbons } from "./shapes.ts";
import type { Body } from "./sketch.ts";

export const maxBodies = 16;
const maxPlaces = 17;
const lift_m = 0.05; // over the ground, and over the person's own paths
const otherColor = new Color(yellow);
const followedColor = new Color(orange);

/** An instance's place and size: a cylinder of radius and height 1 about the origin. */
export function placeOf({ x, y, z, radius_m, height_m }: Body): Matrix4 {
  return new Matrix4().compose(new Vector3(x, y, z + height_m / 2), new Quaternion(),
    new Vector3(radius_m, radius_m, height_m));
}

export function pointsOf({ expected }: Body): Point[] {
  return Array.from({ length: Math.min(expected.length / 3, maxPlaces) }, (_, i): Point =>
    [expected[3 * i]!, expected[3 * i + 1]!, expected[3 * i + 2]! + lift_m]);
}

export class Around {
  readonly group = new Group();
  private readonly cylinders = new InstancedMesh(
    new CylinderGeometry(1, 1, 1, 20).rotateX(Math.PI / 2),
    new MeshLambertMaterial({ color: yellow, transparent: true, opacity: 0.6, depthWrite: false }),
    maxBodies);
  private readonly ring = new Mesh(new RingGeometry(1.3, 1.7, 32),
    new MeshBasicMaterial({ color: orange, transparent: true, opacity: 0.8, side: DoubleSide,
      depthWrite: false }));
  private readonly ways = new Ribbons(maxBodies, maxPlaces);

  constructor() {
    this.cylinders.frustumCulled = false;
    this.group.add(this.cylinders, this.ring, this.ways.mesh);
    this.set([]);
  }

  /** The followed person has a body of their own in the scene: no cylinder. */
  set(bodies: readonly Body[]): void {
    const others = bodies.filter((body) => !body.followed).slice(0, maxBodies);
    others.forEach((body, i) => this.cylinders.setMatrixAt(i, placeOf(body)));
    this.cylinders.count = others.length;
    this.cylinders.visible = others.length > 0;
    this.cylinders.instanceMatrix.needsUpdate = true;
    const person = bodies.find((body) => body.followed);
    this.ring.visible = person !== undefined;
    if (person) {
      this.ring.position.set(person.x, person.y, person.z + lift_m);
      this.ring.scale.setScalar(person.radius_m);
    }
    for (let i = 0; i < maxBodies; i++) {
      const body = bodies[i];
      if (!body) this.ways.clear(i);
      else
        this.ways.set(i, pointsOf(body), 0.08,
          () => (body.followed ? followedColor : otherColor), (share) => 0.9 - 0.6 * share);
    }
  }
}
