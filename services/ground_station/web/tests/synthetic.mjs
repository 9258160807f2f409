// SPDX-License-Identifier: Apache-2.0
// A flight that is made up: people walk circles, vehicles follow them. For tests of the page alone.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageWriter } from "@foxglove/omgidl-serialization";

import { flatIdl } from "./flat_idl.mjs";
import { boxOf, colorInfoAt, portrait } from "./synthetic_camera.mjs";

const band_m = 2;
const walk_radps = 0.25;
const circle_m = 4;

const types = {
  "odometry": "nav_msgs/Odometry",
  "target/state": "foretrack_msgs/TargetState",
  "target/intention": "foretrack_msgs/TargetIntention",
  "target/prediction": "foretrack_msgs/TargetPrediction",
  "bodies": "foretrack_msgs/MovingBodies",
  "target/choice": "foretrack_msgs/TargetChoice",
  "camera/ground/image/compressed": "sensor_msgs/CompressedImage",
  "camera/ground/video": "foxglove_msgs/CompressedVideo",
  "camera/ground/camera_info": "sensor_msgs/CameraInfo",
  "camera/color/camera_info": "sensor_msgs/CameraInfo",
  "mission/command": "foretrack_msgs/MissionCommand",
  "plan/trajectory": "foretrack_msgs/PlannedTrajectory",
  "safety/state": "foretrack_msgs/SafetyState",
  "health": "foretrack_msgs/ServiceHealth",
  "map/local": "foretrack_msgs/LocalMap",
  "fmu/out/battery_status": "px4_msgs/BatteryStatus",
  "fmu/out/vehicle_local_position": "px4_msgs/VehicleLocalPosition",
  "diagnostics": "diagnostic_msgs/DiagnosticArray",
};

const writers = new Map();
export function encode(type, message) {
  let writer = writers.get(type);
  if (!writer) {
    const [pkg, name] = type.split("/");
    writer = new MessageWriter(`${pkg}::msg::${name}`, parseIDL(flatIdl(type)));
    writers.set(type, writer);
  }
  return writer.writeMessage(message);
}

export function schemaNameOf(type) {
  return type.replace("/", "::msg::");
}
export function typeOf(name) {
  return types[name];
}

export const stampOf = (time_s) => ({ sec: Math.floor(time_s),
  nanosec: Math.round((time_s % 1) * 1e9) });
export const headerOf = (time_s) => ({ stamp: stampOf(time_s), frame_id: "map" });
const quaternionOf = (yaw) => ({ x: 0, y: 0, z: Math.sin(yaw / 2), w: Math.cos(yaw / 2) });
const zeros36 = new Array(36).fill(0);

/** Where the person of vehicle number `index` is. */
export function personAt(time_s, index = 0) {
  const angle = walk_radps * time_s;
  const [cx, cy] = [12 * (index % 4), 12 * Math.floor(index / 4)];
  return { x: cx + circle_m * Math.cos(angle), y: cy + circle_m * Math.sin(angle), z: 1.2,
    yaw: angle + Math.PI / 2, speed: circle_m * walk_radps };
}
export function vehicleAt(time_s, index = 0) {
  const p = personAt(time_s, index);
  const behind = band_m + 0.3 * Math.sin(0.5 * time_s);
  return { x: p.x - behind * Math.cos(p.yaw), y: p.y - behind * Math.sin(p.yaw), z: 1.5,
    yaw: p.yaw + 0.1 * Math.sin(time_s), speed: p.speed, behind };
}

function odometry(t, index) {
  const v = vehicleAt(t, index);
  return { header: headerOf(t), child_frame_id: "base_link",
    pose: { pose: { position: { x: v.x, y: v.y, z: v.z }, orientation: quaternionOf(v.yaw) },
      covariance: zeros36 },
    twist: { twist: { linear: { x: v.speed, y: 0, z: 0 }, angular: { x: 0, y: 0, z: walk_radps } },
      covariance: zeros36 } };
}

function target(t, index) {
  const p = personAt(t, index);
  return { header: headerOf(t), status: 1, position_m: [p.x, p.y, p.z],
    velocity_mps: [p.speed * Math.cos(p.yaw), p.speed * Math.sin(p.yaw), 0], covariance: zeros36,
    body_yaw_rad: p.yaw, body_yaw_variance_rad2: 0.01, last_measurement_age_s: 0.02,
    rejected_measurements: 0 };
}

// Not those of the product: whatever a message says is shown.
export const colors_rgb =
  { forward: 0x56b4e9, left: 0xe69f00, right: 0x2fc79b, deceleration: 0xd98cbb };

export function probabilities(t) {
  const left = 0.3 + 0.25 * Math.sin(0.7 * t);
  return { forward: 0.9 - left - 0.05, left, right: 0.05, deceleration: 0.1 };
}

function intention(t, index) {
  const p = personAt(t, index);
  const region = { center_m: [p.x, p.y, p.z], radius_m: 2.2, heading_rad: p.yaw,
    left_bisector_yaw_rad: p.yaw + 0.5, left_half_angle_rad: 0.5,
    right_bisector_yaw_rad: p.yaw - 0.5, right_half_angle_rad: 0.4 };
  return { header: headerOf(t), obstacle_distance_m: 3, body_turn_angle_rad: 0.1,
    region_now: region,
    region_ahead: { ...region, center_m: [p.x + Math.cos(p.yaw), p.y + Math.sin(p.yaw), p.z] },
    intentions: Object.entries(probabilities(t)).map(([name, probability]) =>
      ({ name, color_rgb: colors_rgb[name], potential: 0, observation: 0, score: 0,
        probability })) };
}

function prediction(t, index) {
  const p = personAt(t, index);
  const turn = { forward: 0, left: 0.6, right: -0.6, deceleration: 0 };
  const paths = Object.entries(probabilities(t)).map(([name, probability]) => {
    const speed = name === "deceleration" ? 0.3 : p.speed;
    const states = Array.from({ length: 16 }, (_, i) => {
      const s = 0.2 * i;
      const yaw = p.yaw + turn[name] * s * 0.5;
      return { time_from_stamp_s: s, velocity_mps: [0, 0, 0], covariance_xy_m2: [0, 0, 0, 0],
        position_m: [p.x + speed * s * Math.cos(yaw), p.y + speed * s * Math.sin(yaw), p.z] };
    });
    return { name, color_rgb: colors_rgb[name], probability, states };
  });
  return { header: headerOf(t), status: 0, paths, expansions: 100, compute_ms: 2.5 };
}

const nowhere4 = new Array(4).fill(0);

/** The person, and one who walks a smaller circle the other way round. */
export function peopleAt(t, index = 0) {
  const [cx, cy] = [12 * (index % 4), 12 * Math.floor(index / 4)];
  const angle = -0.6 * t;
  return [{ id: 1, ...personAt(t, index) }, { id: 2, x: cx + 1.5 * Math.cos(angle),
    y: cy + 1.5 * Math.sin(angle), yaw: angle - Math.PI / 2, speed: 0.9 }];
}

function bodies(t, index, chosen = 1) {
  const [p, other] = peopleAt(t, index);
  const look = (at) => {
    const box_px = boxOf(t, index, at);
    return box_px ? { look_age_s: 0, box_px } : { look_age_s: -1, box_px: nowhere4 };
  };
  const body = (id, followed, { x, y, yaw, speed }, places_m) => ({ id, kind: 0,
    followed, position_m: [x, y, 0], velocity_mps: [speed * Math.cos(yaw), speed * Math.sin(yaw), 0],
    position_covariance_m2: [0.01, 0, 0, 0.01], velocity_covariance_m2_s2: [0.1, 0, 0, 0.1],
    radius_m: 0.25, height_m: 1.75, place_step_s: 0.2, places_m, ...look({ x, y }),
    landmarks: [], body_yaw_rad: NaN, head_yaw_rad: NaN });
  const places = Array.from({ length: 15 }, (_, k) => {
    const { x, y } = personAt(t + 0.2 * (k + 1), index);
    return { x, y, z: 0 };
  });
  return { header: headerOf(t), bodies: [body(1, chosen === 1, p, places),
    body(2, chosen === 2, other, [])] };
}

const portraits = {};
const portraitOf = (id) => (portraits[id] ??= portrait(id));

/** state: as in TargetChoice; in doubt, both are candidates. */
function choice(t, index, { state = 1, person_id = 1 } = {}) {
  const candidates = state === 2 ? [1, 2].map((id) => ({ person_id: id, likeness: 0.9 - 0.2 * id,
    position_m: [0, 0, 1.2], picture: portraitOf(id) })) : [];
  return { header: headerOf(t), state, person_id, likeness: state === 1 ? 0.93 : 0.5,
    waits_s: state === 2 ? 8 : 0, picture: portraitOf(1), candidates };
}

function box(x, y) {
  const face = (normal, offset_m) => ({ normal, offset_m });
  return { faces: [face([1, 0, 0], x + 1.2), face([-1, 0, 0], -x + 1.2), face([0, 1, 0], y + 1.2),
    face([0, -1, 0], -y + 1.2), face([0, 0, 1], 2), face([0, 0, -1], -1)] };
}

function plan(t, index, id) {
  const v = vehicleAt(t, index);
  const p = personAt(t, index);
  const [vx, vy] = [v.speed * Math.cos(v.yaw), v.speed * Math.sin(v.yaw)];
  const row = (x, y, z) => [x, y, z];
  const coefficients = [row(v.x, v.y, v.z), row(vx, vy, 0), row(-0.1 * vy, 0.1 * vx, 0),
    ...Array.from({ length: 3 }, () => [0, 0, 0])].flat();
  return { header: headerOf(t), id, start: stampOf(t), status: 1, reason: 0, text: "",
    pieces: [{ duration_s: 3, coefficients }], tail_start_s: 2.2,
    yaw: { dt_s: 0, nodes: [] }, gimbal_pitch: { dt_s: 0, nodes: [] },
    visible_regions: [0, 1, 2].map((s) => ({ time_from_start_s: s,
      target_position_m: [p.x, p.y, p.z], bisector_yaw_rad: p.yaw + Math.PI, half_angle_rad: 0.6,
      waypoint_m: [v.x, v.y, v.z] })),
    corridor: [box(v.x, v.y), box(v.x + vx, v.y + vy)],
    stage_times: [["path", 1.5], ["visible_regions", 0.8], ["corridor", 1.1], ["optimization", 4],
      ["check", 0.5]].map(([stage, ms]) => ({ stage, ms })),
    expansions: 10, iterations: 20 };
}

export const freeFraming =
  { distance_m: NaN, height_m: NaN, bearing_rad: NaN, circling_radps: 0 };

export function safety(t, more = {}) {
  return { header: headerOf(t), caused_by: stampOf(t - 0.08), mode: 0, reason: 0, text: "",
    phase: 1, request: 0, trajectory_id: 1n, plan_age_s: 0.02, odometry_age_s: 0.01,
    deviation_m: 0.05, offboard: true, armed: true, heartbeat: true, setpoint_valid: true,
    position_m: [0, 0, 0], velocity_mps: [0, 0, 0], acceleration_mps2: [0, 0, 0], yaw_rad: 0,
    yaw_rate_radps: 0,
    command_id: 0n, command: 0, command_result: 0, operator_id: "", lease_operator: "",
    lease_remaining_s: 0, mission_end: 0, asked: 0, answer: 0, dry_run: false, alarm: "",
    chosen: false, person_id: 0, framing: freeFraming, fence_m: [], altitude_min_m: NaN,
    altitude_max_m: NaN, home_known: true, home_m: [0, 0, 0], ...more };
}

export function health(t, service, more = {}) {
  return { header: headerOf(t), service, state: 0, uptime_s: t % 1000, cpu_percent: 12,
    rss_bytes: 30000000n, loops: 100n, loop_mean_ms: 0.4, loop_max_ms: 2, foreign_endpoints: 0,
    last_error: "", topics: [{ topic: "odometry", writes: false, samples: 100n, rate_hz: 50,
      age_s: 0.01, peers: 1, rejected: [{ reason: "stamp", samples: 3n }] }], ...more };
}

export function wallMap(t, index) {
  const [size_x, size_y, size_z] = [80, 80, 16];
  const n = size_x * size_y * size_z;
  const cells = new Uint8Array(n);
  for (let k = 0; k < size_z; k++)
    for (let j = 0; j < size_y; j++)
      for (let i = 0; i < size_x; i++)
        if (j === 4 || i === 3 || (i % 20 < 4 && j % 20 > 14))
          cells[i + size_x * (j + size_y * k)] = 1;
  const [cx, cy] = [12 * (index % 4), 12 * Math.floor(index / 4)];
  return { header: headerOf(t), resolution_m: 0.15, origin_m: [cx - 6, cy - 6, 0], size_x, size_y,
    size_z, cells, occupied_distance_cm: new Uint8Array(n), unfree_distance_cm: new Uint8Array(n) };
}

const battery = (t) => ({ timestamp: 0n, connected: true, voltage_v: 15.4, current_a: 1,
  current_average_a: 1, discharged_mah: 1, remaining: 0.72 - (t % 100) * 0.001, scale: 1,
  time_remaining_s: 300, temperature: 20, cell_count: 4, source: 0, priority: 0, capacity: 1,
  cycle_count: 1, average_time_to_empty: 1, serial_number: 1, manufacture_date: 1,
  state_of_health: 1, max_error: 1, id: 0, interface_error: 0,
  voltage_cell_v: new Array(14).fill(0),
  max_cell_voltage_delta: 0, is_powering_off: false, is_required: false, warning: 0, faults: 0,
  full_charge_capacity_wh: 1, remaining_capacity_wh: 1, over_discharge_count: 0,
  nominal_voltage: 1, internal_resistance_estimate: 1, ocv_estimate: 1, ocv_estimate_filtered: 1,
  volt_based_soc_estimate: 1, voltage_prediction: 1, prediction_error: 1,
  estimation_covariance_norm: 1 });

/** Of the made-up world's frame. */
export const origin = { lat_deg: 52.52, lon_deg: 13.41 };
const localPosition = { timestamp: 0n, timestamp_sample: 0n, xy_valid: false, z_valid: false,
  v_xy_valid: false, v_z_valid: false, x: 0, y: 0, z: 0, delta_xy: [0, 0], xy_reset_counter: 0,
  delta_z: 0, z_reset_counter: 0, vx: 0, vy: 0, vz: 0, z_deriv: 0, delta_vxy: [0, 0],
  vxy_reset_counter: 0, delta_vz: 0, vz_reset_counter: 0, ax: 0, ay: 0, az: 0, heading: 0,
  heading_var: 0, unaided_heading: 0, delta_heading: 0, heading_reset_counter: 0,
  heading_good_for_control: false, tilt_var: 0, xy_global: true, z_global: true, ref_timestamp:
  1n, ref_lat: origin.lat_deg, ref_lon: origin.lon_deg, ref_alt: 40, dist_bottom_valid: false,
  dist_bottom: 0, dist_bottom_var: 0, delta_dist_bottom: 0, dist_bottom_reset_counter: 0,
  dist_bottom_sensor_bitfield: 0, eph: 0, epv: 0, evh: 0, evv: 0, dead_reckoning: false, vxy_max:
  0, vz_max: 0, hagl_min: 0, hagl_max_z: 0, hagl_max_xy: 0 };

/** What the planner of a vehicle says of itself. */
export function diagnosticsOf(t, name, [low_m, high_m]) {
  const row = (key, value) => ({ key, value: value.toFixed(6) });
  return { header: headerOf(t), status: [{ level: 0, name: `${name}/planning`, message: "running",
    hardware_id: name, values: [row("distance_low_m", low_m), row("distance_high_m", high_m)] }] };
}

const services = ["perception", "mapping", "prediction", "planning", "safety_gate"];

/** The samples of one vehicle in step number `step` of 100 a second: [topic's name, message]. */
export function samplesAt(t, step, index, orders = {}, chosen = {}) {
  const samples = [];
  if (step % 2 === 0) samples.push(["odometry", odometry(t, index)]);
  if (step % 4 === 0)
    samples.push(["target/state", target(t, index)], ["target/intention", intention(t, index)],
      ["target/prediction", prediction(t, index)], ["bodies", bodies(t, index, chosen.person_id ?? 1)],
      ["plan/trajectory", plan(t, index, BigInt(step + 1))]);
  if (step % 5 === 0) samples.push(["safety/state", safety(t, orders)]);
  if (step % 20 === 0) samples.push(["target/choice", choice(t, index, chosen)]);
  if (step % 50 === 0) samples.push(colorInfoAt(t));
  if (step % 100 === 0)
    for (const service of services) samples.push(["health", health(t, service)]);
  if (step % 200 === 0) samples.push(["map/local", wallMap(t, index)]);
  if (step % 100 === 50)
    samples.push(["fmu/out/battery_status", battery(t)],
      ["fmu/out/vehicle_local_position", localPosition]);
  return samples;
}
