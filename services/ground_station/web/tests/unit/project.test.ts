// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import type { CameraInfo, Pose, TransformStamped } from "../../src/data/messages.ts";
import { mountOf, poseAt, project, projectLine, type View } from "../../src/picture/project.ts";
import { History } from "../../src/store/history.ts";
import { makeState, makeVehicle } from "../../src/store/state.ts";
import { boxOf } from "../synthetic_camera.mjs";
import { vehicleAt } from "../synthetic.mjs";
import { odometry, stamp } from "./make.ts";

const info: CameraInfo = { header: { stamp: stamp(0), frame_id: "" }, width: 640, height: 480,
  distortion_model: "plumb_bob", d: [0, 0, 0, 0, 0], k: [320, 0, 320, 0, 320, 240, 0, 0, 1] };
const none = { x: 0, y: 0, z: 0 };
const ahead: Pose = { position: none, orientation: { x: -0.5, y: 0.5, z: -0.5, w: 0.5 } };
const yawed = (yaw: number) => ({ x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) });
const viewAt = (x: number, y: number, z: number, yaw: number): View =>
  ({ info, mount: ahead, vehicle: { position: { x, y, z }, orientation: yawed(yaw) } });

test("a point ahead is in the middle, one to the left is to the left, one above is above", () => {
  const view = viewAt(1, 2, 1.5, Math.PI / 2); // looks north
  const near = (pixel: number[] | null, x: number, y: number): void =>
    assert.ok(pixel && Math.hypot(pixel[0]! - x, pixel[1]! - y) < 1e-6, `${pixel}`);
  near(project(view, [1, 6, 1.5]), 320, 240);
  near(project(view, [0, 6, 1.5]), 240, 240);
  near(project(view, [1, 6, 2.5]), 320, 160);
  assert.equal(project(view, [1, 1, 1.5]), null);
});

test("the made-up flight's own camera agrees", () => {
  const v = vehicleAt(3);
  const at = { x: v.x + 3 * Math.cos(v.yaw) - 0.5 * Math.sin(v.yaw),
    y: v.y + 3 * Math.sin(v.yaw) + 0.5 * Math.cos(v.yaw) };
  const [left, , right, bottom] = boxOf(3, 0, at)!;
  const foot = project(viewAt(v.x, v.y, v.z, v.yaw), [at.x, at.y, 0])!;
  assert.ok(Math.abs(foot[0] - (left! + right!) / 2) < 1e-6);
  assert.ok(Math.abs(foot[1] - bottom!) < 1e-6);
});

test("a lens that bends inwards draws a point nearer to the middle", () => {
  const bent = { ...viewAt(0, 0, 0, 0), info: { ...info, d: [-0.2, 0, 0, 0, 0] } };
  const pixel = project(bent, [2, -1, 0])!;
  assert.ok(pixel[0] > 320 && pixel[0] < 480);
});

test("a way that leads behind the camera ends at its plane, and comes back in another piece", () => {
  const pieces = projectLine(viewAt(0, 0, 1, 0),
    [[4, 1, 0], [2, 1, 0], [-2, 1, 0], [-2, -1, 0], [2, -1, 0]]);
  assert.equal(pieces.length, 2);
  assert.equal(pieces[0]!.length, 3);
  assert.equal(pieces[1]!.length, 2);
  assert.ok(pieces.flat().every(([x, y]) => Number.isFinite(x) && Number.isFinite(y)));
});

test("the pose is that of the image's stamp, not the newest", () => {
  const poses = new History<ReturnType<typeof odometry> & { header: never }>();
  for (let i = 0; i <= 10; i++) poses.push(100 + i / 10, odometry(i, 0, i / 10) as never);
  const pose = poseAt(poses as never, 100.55)!;
  assert.ok(Math.abs(pose.position.x - 5.5) < 1e-6);
  assert.ok(Math.abs(2 * Math.atan2(pose.orientation.z, pose.orientation.w) - 0.55) < 1e-3);
  assert.ok(poseAt(poses as never, 101.2));
  assert.equal(poseAt(poses as never, 101.5), null);
});

test("the mount is what transforms say, else what perception says, else ahead", () => {
  const [state, vehicle] = [makeState(), makeVehicle("uav1", 0)];
  assert.deepEqual(mountOf(state, vehicle, "eye"), ahead);
  const said: Pose = { position: { x: 1, y: 0, z: 0 }, orientation: ahead.orientation };
  vehicle.latest["target/observation"] = { time_s: 0,
    message: { header: info.header, kind: 0, camera: { pose_body: said } as never } };
  assert.deepEqual(mountOf(state, vehicle, "eye"), said);
  const step = (parent: string, child: string, x: number, yaw: number): TransformStamped =>
    ({ header: { stamp: stamp(0), frame_id: parent }, child_frame_id: child,
      transform: { translation: { x, y: 0, z: 0 }, rotation: yawed(yaw) } });
  state.mounts.set("uav1/eye", step("uav1/arm", "uav1/eye", 1, 0));
  state.mounts.set("uav1/arm", step("uav1/base_link", "uav1/arm", 0.5, Math.PI / 2));
  const { position } = mountOf(state, vehicle, "eye");
  assert.ok(Math.hypot(position.x - 0.5, position.y - 1, position.z) < 1e-9);
});
