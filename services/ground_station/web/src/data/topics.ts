// SPDX-License-Identifier: Apache-2.0
// Which topics the page reads, and how much of each.

/** all: every sample. newest: the newest of a frame. slow: the newest, at most twice a second. */
export type Reading = "all" | "newest" | "slow";

const readings: Record<string, Reading> = {
  "odometry": "newest",
  "target/state": "newest",
  "target/observation": "slow",
  "target/intention": "newest",
  "target/prediction": "newest",
  "bodies": "newest",
  "plan/trajectory": "newest",
  "target/search": "newest",
  "target/choice": "newest",
  "fleet/division": "newest",
  "camera/ground/image/compressed": "newest",
  "camera/ground/video": "all",
  "camera/ground/camera_info": "newest",
  "camera/color/camera_info": "slow",
  "safety/state": "all",
  "mission/command": "all",
  "health": "all",
  "map/points": "slow",
  "map/local": "slow",
  "diagnostics": "all",
  "tf_static": "all",
  "fmu/out/battery_status": "slow",
  "fmu/out/vehicle_local_position": "slow",
  "station/status": "all",
};

/** Sent once or seldom and good until the next: a replay seeks the last one before its place. */
export const lasting = ["map/points", "map/local", "target/observation", "fmu/out/battery_status",
  "camera/color/camera_info", "tf_static", "fmu/out/vehicle_local_position"];

/** Of the station itself. */
export const statusTopic = "/station/status";

/** Read only while somebody looks: it is most of the flow. */
export const pictureTopic = "camera/ground/image/compressed";
export const videoTopic = "camera/ground/video";
export function isOnDemand(topic: string): boolean {
  const { name } = partsOf(topic);
  return name === pictureTopic || name === videoTopic;
}

/** uav2 before uav10. */
export const byName = (a: string, b: string): number =>
  a.localeCompare(b, undefined, { numeric: true });

export interface TopicParts { vehicle: string; name: string }

const shared = new Set(["tf", "tf_static", "diagnostics", "clock", "station/status",
  "ros_discovery_info", "fleet/member"]);

/** PX4's releases number the versions of some messages: "fmu/out/vehicle_status_v1". */
const plain = (name: string): string =>
  name.startsWith("fmu/") ? name.replace(/_v\d+$/, "") : name;

/** "/uav1/target/state" → uav1, target/state. PX4's topics keep their namespace as the vehicle. */
export function partsOf(topic: string): TopicParts {
  const path = topic.replace(/^\//, "").replace(/^rt\//, "");
  if (shared.has(path)) return { vehicle: "", name: path };
  if (path.startsWith("fmu/")) return { vehicle: "", name: plain(path) };
  const slash = path.indexOf("/");
  if (slash < 0) return { vehicle: "", name: path };
  return { vehicle: path.slice(0, slash), name: plain(path.slice(slash + 1)) };
}

/** undefined: the page does not read it. */
export function readingOf(topic: string): Reading | undefined {
  return readings[partsOf(topic).name];
}

/**
 * The autopilot's namespace px4_3 belongs to the vehicle whose name ends in 3, none to the one whose
 * name ends in 1; any to the only vehicle.
 */
export function ownerOf(namespace: string, vehicles: string[]): string | undefined {
  if (vehicles.includes(namespace)) return namespace;
  const isAutopilot = namespace === "" || /^px4_\d+$/.test(namespace);
  if (!isAutopilot) return undefined;
  if (vehicles.length === 1) return vehicles[0];
  const number = /(\d+)$/.exec(namespace)?.[1] ?? "1";
  return vehicles.find((name) => /(\d+)$/.exec(name)?.[1] === number);
}
