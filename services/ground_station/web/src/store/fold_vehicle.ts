// SPDX-License-Identifier: Apache-2.0
// What each topic of a vehicle adds to its series, trails and ladder, and the events it makes.
import {
  type BatteryStatus, type CompressedVideo, type FleetDivision, type MissionCommand, type MovingBodies, type Odometry, type PlannedTrajectory, seconds,
  type SafetyState, type ServiceHealth, type TargetIntention, type TargetState,
} from "../data/messages.ts";
import type { Sample } from "../data/sample.ts";
import * as words from "../data/words.ts";
import {
  GateReason, leaseCommand, Mode, PlanState, Result, ServiceState, Track, Trust,
} from "../data/words.ts";
import { colorOfRgb } from "../ui/palette.ts";
import { t } from "../ui/words.ts";
import { hold, note } from "./alarms.ts";
import { distance_m, speed_mps, yawError_rad } from "./derive.ts";
import type { Rung, Severity, State, Vehicle } from "./state.ts";

type Fold = (state: State, vehicle: Vehicle, sample: Sample) => void;

const foldOdometry: Fold = (_state, vehicle, { message, time_s }) => {
  const odometry = message as Odometry;
  const { x, y, z } = odometry.pose.pose.position;
  vehicle.trail.push(time_s, x, y, z);
  vehicle.poses.push(seconds(odometry.header.stamp), odometry);
  const target = vehicle.latest["target/state"]?.message;
  const v = target && target.status !== Track.none
    ? Math.hypot(target.velocity_mps[0]!, target.velocity_mps[1]!) : null;
  const error = yawError_rad(odometry, target);
  vehicle.speed.push(time_s, [speed_mps(odometry), v]);
  vehicle.distance.push(time_s, [distance_m(odometry, target)]);
  vehicle.yawError.push(time_s, [error === null ? null : (error * 180) / Math.PI]);
};

const foldTarget: Fold = (state, vehicle, { message, time_s }) => {
  const target = message as TargetState;
  extend(vehicle.lanes.person, time_s, target.status, words.trackWord(target.status), "");
  if (target.status === Track.none) return;
  const [x, y, z] = [target.position_m[0]!, target.position_m[1]!, target.position_m[2]!];
  vehicle.targetTrail.push(time_s, x, y, z);
  hold(state, vehicle.name, "target", target.status === Track.lost, "warning",
    t("the person is lost"));
};

const foldIntention: Fold = (_state, vehicle, { message, time_s }) => {
  const { intentions } = message as TargetIntention;
  for (const { name, color_rgb } of intentions)
    vehicle.intentionColors.set(name, colorOfRgb(color_rgb));
  vehicle.intention.pushNamed(time_s, new Map(intentions.map((i) => [i.name, i.probability])));
};

const foldPlan: Fold = (state, vehicle, { message, time_s }) => {
  const plan = message as PlannedTrajectory;
  const times = new Map(plan.stage_times.filter((s) => s.stage !== "total")
    .map((s) => [s.stage, s.ms]));
  const prediction = vehicle.latest["target/prediction"]?.message;
  if (prediction) times.set("predict", prediction.compute_ms);
  vehicle.planTime.pushNamed(time_s, times);
  const why = plan.reason === 0 ? "" : words.explainPlan(plan.reason);
  extend(vehicle.lanes.plan, time_s, plan.status, words.planWord(plan.status), why);
  const bad = plan.status === PlanState.none || plan.status === PlanState.search ||
    plan.status === PlanState.hold;
  hold(state, vehicle.name, "plan", bad, "warning",
    t("plan: {state}, {why}",
      { state: words.planWord(plan.status), why: words.explainPlan(plan.reason) }));
};

export function severityOf(safety: SafetyState): Severity {
  const ordered = safety.reason === GateReason.mission || safety.reason === GateReason.none;
  if (safety.mode === Mode.brake) return ordered ? "warning" : "alarm";
  if (safety.mode === Mode.silent && safety.reason === GateReason.mission) return "info";
  if (safety.mode === Mode.silent) return safety.armed ? "alarm" : "warning";
  if (safety.mode === Mode.track || ordered) return "info";
  return "warning";
}

const foldSafety: Fold = (state, vehicle, { message, time_s }) => {
  const safety = message as SafetyState;
  compare(state, vehicle, safety);
  climb(state, vehicle, safety, time_s);
  hold(state, vehicle.name, "second writer", Boolean(safety.alarm), "alarm", safety.alarm ?? "");
  measureLatency(vehicle, safety, time_s);
};

// The first cause that is heard may be old: its setpoint may have come before we listened.
function measureLatency(vehicle: Vehicle, safety: SafetyState, time_s: number): void {
  const cause_s = seconds(safety.caused_by);
  const before_s = vehicle.caused_by_s;
  const beganAnew = cause_s > 0 && cause_s < before_s - 5; // the flight's clock
  if (!safety.setpoint_valid || (cause_s <= before_s && !beganAnew)) return;
  vehicle.caused_by_s = cause_s;
  if (before_s === -Infinity || beganAnew) return;
  vehicle.latency.push(time_s, [1e3 * (seconds(safety.header.stamp) - cause_s)]);
}

/** A reason that keeps changing while the state stays makes new rungs; silence makes a gap. */
function extend(rungs: Rung[], time_s: number, state: number, word: string, why: string): boolean {
  const last = rungs[rungs.length - 1];
  const goesOn = last !== undefined && time_s - last.to_s < 2;
  if (goesOn) last.to_s = time_s;
  if (goesOn && last.state === state && last.why === why) return false;
  rungs.push({ from_s: time_s, to_s: time_s, state, word, why });
  if (rungs.length > 2000) rungs.splice(0, 500);
  return true;
}

function climb(state: State, vehicle: Vehicle, safety: SafetyState, time_s: number): void {
  const why = safety.reason === GateReason.none ? "" : words.explainGate(safety.reason);
  const word = words.modeWord(safety.mode);
  extend(vehicle.lanes.mission, time_s, safety.phase, words.phaseWord(safety.phase), "");
  if (!extend(vehicle.lanes.gate, time_s, safety.mode, word, why)) return;
  const severity = severityOf(safety);
  const text = t("gate: {mode}", { mode: why ? `${word}, ${why}` : word });
  if (severity === "info") note(state, vehicle.name, "info", text);
  hold(state, vehicle.name, "gate", severity !== "info", severity, text);
}

function compare(state: State, vehicle: Vehicle, now: SafetyState): void {
  const before = vehicle.latest["safety/state"]?.message;
  if (!before) return;
  if (before.phase !== now.phase)
    note(state, vehicle.name, "info", t("mission: {phase}", { phase: words.phaseWord(now.phase) }));
  if (before.armed !== now.armed)
    note(state, vehicle.name, "info", now.armed ? t("armed") : t("disarmed"));
  if (before.offboard !== now.offboard)
    note(state, vehicle.name, "info", now.offboard ? t("in offboard mode") : t("left offboard mode"));
  if (now.mission_end && before.mission_end !== now.mission_end)
    note(state, vehicle.name, "warning", t("mission over: {why}", { why: words.explainEnd(now.mission_end) }));
  const [from, to] = [before.lease_operator ?? "", now.lease_operator ?? ""];
  if (from !== to)
    note(state, vehicle.name, "info", to ? t("{who} has control", { who: to }) : t("{who} gave up control", { who: from }));
  const isNew = before.command_id !== now.command_id || before.command_result !== now.command_result;
  const taken: number[] = [Result.accepted, Result.pending, Result.acceptedUnwritten];
  const refused = now.command_result > 0 && !taken.includes(now.command_result);
  if (!isNew || now.command_result === Result.pending || (now.command === leaseCommand && !refused)) return;
  const order = now.command === undefined ? t("command") : words.commandWord(now.command);
  note(state, vehicle.name, refused ? "warning" : "info",
    t("{order} of {who}: {result}", { order, who: now.operator_id || t("someone"),
      result: words.resultWord(now.command_result) }));
}

const foldCommand: Fold = (state, vehicle, { message }) => {
  const { command, operator_id } = message as MissionCommand;
  if (command === leaseCommand) return;
  note(state, vehicle.name, "info",
    t("{who} orders: {order}",
      { who: operator_id || t("someone"), order: words.commandWord(command) }));
};

const foldBodies: Fold = (_state, vehicle, { message }) => {
  const bodies = message as MovingBodies;
  vehicle.looks.push(seconds(bodies.header.stamp), bodies);
};

const foldVideo: Fold = (_state, vehicle, { message }) => {
  vehicle.video.push(message as CompressedVideo);
};

const foldDivision: Fold = (state, vehicle, { message }) => {
  const known = new Set(vehicle.latest["fleet/division"]?.message.peers.map((p) => p.vehicle));
  for (const peer of (message as FleetDivision).peers) {
    if (!known.delete(peer.vehicle))
      note(state, vehicle.name, "info", t("{other} flies along", { other: peer.vehicle }));
    hold(state, vehicle.name, `liar ${peer.vehicle}`, peer.trust === Trust.liar, "warning",
      t("{other} sees the person where they are not", { other: peer.vehicle }));
  }
  for (const other of known) note(state, vehicle.name, "warning", t("{other} is heard no more", { other }));
};

const foldHealth: Fold = (state, vehicle, { message }) => {
  const health = message as ServiceHealth;
  const doubtful = words.saysSeveralPeople(health);
  hold(state, vehicle.name, `person ${health.service}`, doubtful, "alarm", t(words.severalPeople));
  const degraded = health.state === ServiceState.degraded && !doubtful;
  hold(state, vehicle.name, `service ${health.service}`, degraded, "warning",
    t("{service}: degraded, {why}", { service: health.service, why: health.last_error }));
  hold(state, vehicle.name, `foreign ${health.service}`, health.foreign_endpoints > 0, "warning",
    t("{service}: {count} endpoints of a foreign type",
      { service: health.service, count: health.foreign_endpoints }));
};

const foldBattery: Fold = (state, vehicle, { message }) => {
  const battery = message as BatteryStatus;
  const severity = battery.warning > 1 ? "alarm" : "warning";
  hold(state, vehicle.name, "battery", battery.warning > 0, severity,
    t("battery: {state}, {percent} %", { state: words.batteryWord(battery.warning),
      percent: Math.round(100 * battery.remaining) }));
};

export const folders: Record<string, Fold> = {
  "odometry": foldOdometry,
  "target/state": foldTarget,
  "target/intention": foldIntention,
  "plan/trajectory": foldPlan,
  "bodies": foldBodies,
  "camera/ground/video": foldVideo,
  "safety/state": foldSafety,
  "mission/command": foldCommand,
  "fleet/division": foldDivision,
  "health": foldHealth,
  "fmu/out/battery_status": foldBattery,
};
