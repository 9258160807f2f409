// SPDX-License-Identifier: Apache-2.0
// What we read of the messages in idl/, with their field names. World ENU, body FLU, SI, rad.

export interface Time { sec: number; nanosec?: number; nsec?: number }
export interface Header { stamp: Time; frame_id: string }
export type Vec3 = ArrayLike<number>; // three numbers

export interface Xyz { x: number; y: number; z: number }
export interface Quaternion extends Xyz { w: number }
export interface Pose { position: Xyz; orientation: Quaternion }

export interface Odometry {
  header: Header;
  child_frame_id: string;
  pose: { pose: Pose };
  twist: { twist: { linear: Xyz; angular: Xyz } };
}

export interface TargetState {
  header: Header;
  status: number;
  position_m: Vec3;
  velocity_mps: Vec3;
  body_yaw_rad: number;
  body_yaw_variance_rad2: number;
  last_measurement_age_s: number;
  rejected_measurements: number;
}

export interface CameraModel {
  width_px: number;
  height_px: number;
  fx_px: number;
  fy_px: number;
  cx_px: number;
  cy_px: number;
  pose_body: Pose;
}
export interface Landmark { image_x_px: number; image_y_px: number; visibility: number }
export interface TargetObservation { header: Header; kind: number; camera: CameraModel }

export interface IntentionScore { name: string; color_rgb: number; probability: number }
export interface ReachableRegion {
  center_m: Vec3;
  radius_m: number;
  heading_rad: number;
  left_bisector_yaw_rad: number;
  left_half_angle_rad: number;
  right_bisector_yaw_rad: number;
  right_half_angle_rad: number;
}
export interface TargetIntention {
  header: Header;
  intentions: IntentionScore[];
  region_now: ReachableRegion;
  region_ahead: ReachableRegion;
}

export interface PredictedPath {
  name: string;
  color_rgb: number;
  probability: number;
  states: { time_from_stamp_s: number; position_m: Vec3 }[];
}
export interface TargetPrediction {
  header: Header;
  status: number;
  paths: PredictedPath[];
  compute_ms: number;
}

export interface MovingBody {
  id: number;
  kind: number;
  followed: boolean;
  position_m: Vec3;
  velocity_mps: Vec3;
  radius_m: number;
  height_m: number;
  place_step_s: number;
  places_m: Xyz[];
  look_age_s?: number; // these are missing in older recordings
  box_px?: ArrayLike<number>;
  landmarks?: Landmark[];
}
export interface MovingBodies { header: Header; bodies: MovingBody[]; camera?: number }

export interface ChoiceCandidate {
  person_id: number;
  likeness: number;
  position_m: Vec3;
  picture: Uint8Array;
}
export interface TargetChoice {
  header: Header;
  state: number;
  person_id: number;
  likeness: number;
  waits_s: number;
  picture: Uint8Array;
  candidates: ChoiceCandidate[];
}

export interface FleetPeer {
  vehicle: string;
  trust: number;
  age_s: number;
  position_m: Vec3;
  separation_m: number;
}
export interface FleetSeat { vehicle: string; seat: number; is_near: boolean; sees: ArrayLike<number> }
export interface FleetDivision {
  header: Header;
  vehicle: string;
  is_alone: boolean;
  seat: number;
  is_near: boolean;
  bearing_rad: number;
  distance_m: number;
  seats: FleetSeat[];
  intentions: { name: string; probability: number }[];
  union_visibility: number;
  separation_m: number;
  peers: FleetPeer[];
}

export interface CompressedImage { header: Header; format: string; data: Uint8Array }
/** H.264 as Annex B: one whole picture, parameter sets with each key picture. */
export interface CompressedVideo { timestamp: Time; frame_id: string; data: Uint8Array; format: string }
export interface CameraInfo {
  header: Header;
  width: number;
  height: number;
  distortion_model: string;
  d: ArrayLike<number>;
  k: ArrayLike<number>; // row by row
}
export interface TransformStamped {
  header: Header;
  child_frame_id: string;
  transform: { translation: Xyz; rotation: Quaternion };
}
export interface TransformMessage { transforms: TransformStamped[] }

/** NaN: as the parameters say; of the bearing: free. */
export interface TargetFraming {
  distance_m: number;
  height_m: number;
  bearing_rad: number;
  circling_radps: number;
}

export interface TrajectoryPiece {
  duration_s: number;
  coefficients: ArrayLike<Vec3> | ArrayLike<number>; // one row a power
}
export interface VisibleRegion {
  time_from_start_s: number;
  target_position_m: Vec3;
  bisector_yaw_rad: number;
  half_angle_rad: number;
  waypoint_m: Vec3;
}
export interface CorridorFace { normal: Vec3; offset_m: number }
export interface PlannedTrajectory {
  header: Header;
  id: bigint;
  start: Time;
  status: number;
  reason: number;
  text: string;
  pieces: TrajectoryPiece[];
  tail_start_s: number;
  visible_regions: VisibleRegion[];
  corridor: { faces: CorridorFace[] }[];
  stage_times: { stage: string; ms: number }[];
}

export interface TargetSearch {
  header: Header;
  mode: number;
  unseen_s: number;
  likeliest_m: Vec3;
  has_viewpoint: boolean;
  viewpoint_m: Vec3;
  gaze_yaw_rad: number;
  speed_max_mps: number;
  corner_m: ArrayLike<number>;
  cell_m: number;
  columns: number;
  rows: number;
  belief: ArrayLike<number>;
}

export interface SafetyState {
  header: Header;
  caused_by: Time;
  mode: number;
  reason: number;
  text: string;
  phase: number;
  plan_age_s: number;
  odometry_age_s: number;
  deviation_m: number;
  offboard: boolean;
  armed: boolean;
  heartbeat: boolean;
  setpoint_valid: boolean;
  command_id: bigint;
  command_result: number;
  operator_id: string;
  command?: number; // these are missing in older recordings
  lease_operator?: string;
  mission_end?: number;
  dry_run?: boolean;
  alarm?: string;
  lease_remaining_s?: number;
  chosen?: boolean;
  person_id?: number;
  framing?: TargetFraming;
  fence_m?: ArrayLike<number>; // x, y of each corner
  altitude_min_m?: number; // NaN: no bound
  altitude_max_m?: number;
  home_known?: boolean;
  home_m?: Vec3; // where `return` leads
}

export interface MissionCommand {
  header: Header;
  id: bigint;
  command: number;
  operator_id: string;
  lease_id: string;
}

export interface ServiceHealth {
  header: Header;
  service: string;
  state: number;
  uptime_s: number;
  cpu_percent: number;
  rss_bytes: bigint;
  loop_mean_ms: number;
  loop_max_ms: number;
  foreign_endpoints: number;
  last_error: string;
  topics: {
    topic: string;
    writes: boolean;
    samples: bigint;
    rate_hz: number;
    age_s: number;
    peers: number;
    rejected: { reason: string; samples: bigint }[];
  }[];
}

export interface PointCloud2 {
  header: Header;
  height: number;
  width: number;
  fields: { name: string; offset: number; datatype: number }[];
  point_step: number;
  data: Uint8Array;
}
export interface LocalMap {
  header: Header;
  resolution_m: number;
  origin_m: Vec3;
  size_x: number;
  size_y: number;
  size_z: number;
  cells: Uint8Array;
}

export interface DiagnosticStatus {
  level: number;
  name: string;
  message: string;
  hardware_id: string;
  values: { key: string; value: string }[];
}
export interface DiagnosticArray { header: Header; status: DiagnosticStatus[] }

export interface VehicleLocalPosition {
  xy_global: boolean;
  ref_lat: number;
  ref_lon: number;
}
export interface BatteryStatus {
  connected: boolean;
  voltage_v: number;
  remaining: number;
  warning: number;
}

export const seconds = (t: Time): number => t.sec + 1e-9 * (t.nanosec ?? t.nsec ?? 0);
