// SPDX-License-Identifier: Apache-2.0
// All that the page knows, at one moment of one flight or recording.
import type {
  BatteryStatus, CameraInfo, CompressedImage, CompressedVideo, DiagnosticStatus, FleetDivision, LocalMap, MovingBodies, Odometry,
  PlannedTrajectory, PointCloud2, SafetyState, ServiceHealth, TargetChoice, TargetIntention,
  TargetObservation, TargetPrediction, TargetSearch, TargetState, TransformStamped,
  VehicleLocalPosition,
} from "../data/messages.ts";
import type { StationStatus } from "../data/station.ts";
import { History } from "./history.ts";
import { Series, Trail } from "./series.ts";
import { VideoRun } from "./video_run.ts";

export interface Heard<T> { message: T; time_s: number }

export interface Latest {
  "odometry": Heard<Odometry>;
  "target/state": Heard<TargetState>;
  "target/observation": Heard<TargetObservation>;
  "target/intention": Heard<TargetIntention>;
  "target/prediction": Heard<TargetPrediction>;
  "bodies": Heard<MovingBodies>;
  "plan/trajectory": Heard<PlannedTrajectory>;
  "target/search": Heard<TargetSearch>;
  "target/choice": Heard<TargetChoice>;
  "fleet/division": Heard<FleetDivision>;
  "camera/ground/image/compressed": Heard<CompressedImage>;
  "camera/ground/video": Heard<CompressedVideo>;
  "camera/ground/camera_info": Heard<CameraInfo>;
  "camera/color/camera_info": Heard<CameraInfo>;
  "safety/state": Heard<SafetyState>;
  "map/points": Heard<PointCloud2>;
  "map/local": Heard<LocalMap>;
  "fmu/out/battery_status": Heard<BatteryStatus>;
  "fmu/out/vehicle_local_position": Heard<VehicleLocalPosition>;
}

/** A stretch of time in which something stayed in one state for one reason. */
export interface Rung {
  from_s: number;
  to_s: number;
  state: number;
  word: string;
  why: string; // "": all is well
}
export type Lane = "person" | "plan" | "mission" | "gate";

export interface Vehicle {
  name: string;
  index: number; // its colour: by the number in its name, else in order of appearance
  heard_s: number; // when anything of it came last
  latest: Partial<Latest>;
  services: Map<string, Heard<ServiceHealth>>;
  lost_before: Map<string, number>; // rejected samples by service, to tell new ones
  intention: Series;
  intentionColors: Map<string, string>; // by name, as the messages say
  distance: Series;
  speed: Series;
  yawError: Series;
  planTime: Series;
  latency: Series;
  lanes: Record<Lane, Rung[]>;
  caused_by_s: number;
  trail: Trail;
  targetTrail: Trail;
  poses: History<Odometry>; // by their own stamps, for what was seen then
  looks: History<MovingBodies>;
  video: VideoRun;
}

export interface Traffic {
  topic: string;
  vehicle: string;
  name: string;
  type: string;
  count: number;
  bytes: number; // of the newest sample
  total: number; // bytes of all
  heard_s: number;
  rate_hz: number;
  bytes_s: number;
  mark: { time_s: number; count: number; total: number }; // where the rate was taken last
}

export type Severity = "info" | "warning" | "alarm";

export interface FlightEvent {
  id: number;
  time_s: number;
  vehicle: string;
  severity: Severity;
  text: string;
}

/** A condition that holds until it clears; it leaves the list when cleared and acknowledged. */
export interface Alarm {
  key: string;
  vehicle: string;
  severity: Severity;
  text: string;
  since_s: number;
  cleared_s: number | null;
  acknowledged: boolean;
}

export interface State {
  now_s: number; // of the flight that is shown: station's clock live, log time in a replay
  link: { open: boolean; since_s: number; reason: string };
  station: Heard<StationStatus> | null;
  vehicles: Map<string, Vehicle>;
  traffic: Map<string, Traffic>;
  diagnostics: Map<string, Heard<DiagnosticStatus>>;
  mounts: Map<string, TransformStamped>; // tf_static, by child's frame
  events: FlightEvent[];
  alarms: Map<string, Alarm>;
  nextEvent: number;
}

export function makeState(): State {
  return {
    now_s: 0,
    link: { open: false, since_s: 0, reason: "not connected yet" },
    station: null,
    vehicles: new Map(),
    traffic: new Map(),
    diagnostics: new Map(),
    mounts: new Map(),
    events: [],
    alarms: new Map(),
    nextEvent: 1,
  };
}

export function makeVehicle(name: string, before: number): Vehicle {
  const number = Number(/(\d+)$/.exec(name)?.[1] ?? 0);
  const index = number > 0 ? number - 1 : before;
  return {
    name, index, heard_s: -Infinity, latest: {}, services: new Map(), lost_before: new Map(),
    intention: new Series([]), intentionColors: new Map(),
    distance: new Series(["distance"]),
    speed: new Series(["vehicle", "person"]),
    yawError: new Series(["yaw error"]),
    planTime: new Series([]),
    latency: new Series(["latency"], 0.02),
    lanes: { person: [], plan: [], mission: [], gate: [] }, caused_by_s: -Infinity,
    trail: new Trail(), targetTrail: new Trail(),
    poses: new History(), looks: new History(), video: new VideoRun(),
  };
}

/** Negative: it never came. */
export function age_s(state: { now_s: number }, heard: { time_s: number } | undefined): number {
  return heard ? Math.max(0, state.now_s - heard.time_s) : -1;
}
