// SPDX-License-Identifier: Apache-2.0
// The solid things: a vehicle with its camera's frustum, and a person.
import {
  BoxGeometry, BufferGeometry, CapsuleGeometry, Color, ConeGeometry, DoubleSide,
  Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh, MeshLambertMaterial,
  RingGeometry,
} from "three";
import { mergeGeometries } from "three/addons/utils/BufferGeometryUtils.js";

import type { CameraModel, Pose } from "../data/messages.ts";
import { Track } from "../data/words.ts";
import type { Target } from "./sketch.ts";

const frustumReach_m = 2.2;
const pale = "#c8d3dd";
const torsoHeight_m = 1.2; // of the mean of shoulders and hips

function painted(geometry: BufferGeometry, color: string): BufferGeometry {
  const { r, g, b } = new Color(color);
  const count = geometry.getAttribute("position").count;
  const colors = Array.from({ length: count }, () => [r, g, b]).flat();
  return geometry.setAttribute("color", new Float32BufferAttribute(colors, 3));
}

/** Hull, nose, arms and rotors as one geometry: one call draws a vehicle. */
function airframe(color: string): BufferGeometry {
  const parts = [painted(new BoxGeometry(0.3, 0.16, 0.09), color),
    painted(new ConeGeometry(0.07, 0.16, 12).rotateZ(-Math.PI / 2).translate(0.22, 0, 0), color)];
  for (const [x, y] of [[1, 1], [1, -1], [-1, 1], [-1, -1]] as const)
    parts.push(
      painted(new RingGeometry(0.11, 0.15, 20).translate(0.21 * x, 0.21 * y, 0.06), pale),
      painted(new BoxGeometry(0.32, 0.03, 0.03).rotateZ(Math.atan2(y, x))
        .translate(0.12 * x, 0.12 * y, 0.02), pale));
  return mergeGeometries(parts);
}

export class VehicleBody {
  readonly group = new Group();
  private readonly frustum: LineSegments;
  private cameraKey = "";
  private camera: CameraModel | undefined | null = null; // null: none was set yet

  constructor(color: string) {
    this.group.add(new Mesh(airframe(color),
      new MeshLambertMaterial({ vertexColors: true, side: DoubleSide })));
    this.frustum = new LineSegments(new BufferGeometry(),
      new LineBasicMaterial({ color, transparent: true, opacity: 0.8 }));
    this.group.add(this.frustum);
    this.setCamera(undefined);
  }

  place({ position: p, orientation: q }: Pose): void {
    this.group.position.set(p.x, p.y, p.z);
    this.group.quaternion.set(q.x, q.y, q.z, q.w);
  }

  /** Without a camera model: 90° by 74°, straight ahead. */
  setCamera(camera: CameraModel | undefined): void {
    if (camera === this.camera) return;
    this.camera = camera;
    const key = camera ? JSON.stringify(camera) : "none";
    if (key === this.cameraKey) return;
    this.cameraKey = key;
    const [right, down] = camera && camera.fx_px > 0
      ? [camera.width_px / 2 / camera.fx_px, camera.height_px / 2 / camera.fy_px] : [1, 0.75];
    const d = frustumReach_m;
    const corners = [[right, down], [right, -down], [-right, -down], [-right, down]]
      .map(([x, y]) => [x! * d, y! * d, d]);
    const lines: number[] = [];
    corners.forEach((corner, i) => {
      lines.push(0, 0, 0, ...corner, ...corner, ...corners[(i + 1) % 4]!);
    });
    this.frustum.geometry.setAttribute("position", new Float32BufferAttribute(lines, 3));
    const pose = camera?.pose_body;
    if (pose) {
      this.frustum.position.set(pose.position.x, pose.position.y, pose.position.z);
      const q = pose.orientation;
      this.frustum.quaternion.set(q.x, q.y, q.z, q.w);
    } else {
      this.frustum.quaternion.set(-0.5, 0.5, -0.5, 0.5); // camera z ahead, x right
    }
    this.frustum.geometry.computeBoundingSphere();
  }
}

export class PersonBody {
  readonly group = new Group();
  private readonly skin: MeshLambertMaterial;
  private readonly chest: Group;

  constructor(color: string) {
    this.skin = new MeshLambertMaterial({ color, transparent: true });
    const body = new Mesh(new CapsuleGeometry(0.2, 1.3, 4, 12), this.skin);
    body.rotation.x = Math.PI / 2;
    body.position.z = 0.85 - torsoHeight_m;
    this.chest = new Group();
    const arrow = new Mesh(new ConeGeometry(0.13, 0.38, 4), this.skin);
    arrow.rotation.z = -Math.PI / 2;
    arrow.position.x = 0.42;
    this.chest.add(arrow);
    this.group.add(body, this.chest);
  }

  place({ status, x, y, z, yaw_rad }: Target): void {
    this.group.visible = status !== Track.none;
    this.group.position.set(x, y, z);
    this.chest.visible = yaw_rad !== null;
    this.chest.rotation.z = yaw_rad ?? 0;
    this.skin.opacity = status === Track.tracking ? 1 : status === Track.coasting ? 0.55 : 0.25;
  }
}
