// SPDX-License-Identifier: Apache-2.0
// Inputs of the store, written short.
import { type Input, reduce } from "../../src/store/reduce.ts";
import { makeState, type State } from "../../src/store/state.ts";

export function sample(topic: string, time_s: number, message: unknown, bytes = 100): Input {
  const [, vehicle, ...rest] = topic.split("/");
  return { kind: "sample", sample: { topic, vehicle: vehicle!, name: rest.join("/"), type: "T",
    time_s, bytes, message } };
}

export function fold(inputs: Input[], state: State = makeState()): State {
  for (const input of inputs) reduce(state, input);
  return state;
}

export const stamp = (time_s: number) =>
  ({ sec: Math.floor(time_s), nanosec: Math.round((time_s % 1) * 1e9) });

export function odometry(x: number, y: number, yaw = 0, speed = 0) {
  return { header: { stamp: stamp(0), frame_id: "map" }, child_frame_id: "base_link",
    pose: { pose: { position: { x, y, z: 1.5 },
      orientation: { x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) } } },
    twist: { twist: { linear: { x: speed, y: 0, z: 0 }, angular: { x: 0, y: 0, z: 0 } } } };
}

export function target(x: number, y: number, status = 1) {
  return { header: { stamp: stamp(0), frame_id: "map" }, status, position_m: [x, y, 1.2],
    velocity_mps: [0.6, 0.8, 0], body_yaw_rad: 0, body_yaw_variance_rad2: 0.1,
    last_measurement_age_s: 0, rejected_measurements: 0 };
}

export function safety(stamp_s: number, more: object = {}) {
  return { header: { stamp: stamp(stamp_s), frame_id: "map" }, caused_by: stamp(stamp_s - 0.1),
    mode: 0, reason: 0, text: "", phase: 1, plan_age_s: 0, odometry_age_s: 0, deviation_m: 0,
    offboard: true, armed: true, heartbeat: true, setpoint_valid: true, command_id: 0n,
    command_result: 0, operator_id: "", ...more };
}

export function health(service: string, more: object = {}) {
  return { header: { stamp: stamp(0), frame_id: "" }, service, state: 0, uptime_s: 1,
    cpu_percent: 1, rss_bytes: 1n, loop_mean_ms: 1, loop_max_ms: 1, foreign_endpoints: 0,
    last_error: "", topics: [], ...more };
}
