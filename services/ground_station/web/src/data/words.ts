// SPDX-License-Identifier: Apache-2.0
// The messages' enumerators in words; the same words as the terminal view's.
import { said, t } from "../ui/words.ts";

const track = ["never seen", "tracking", "coasting", "lost"];
const prediction = ["ok", "no target", "target blocked", "search exhausted"];
const plan = ["none", "fresh", "kept", "search", "hold"];
const search = ["nobody is lost", "searching", "waiting"];
const mode = ["track", "coast", "hover", "brake", "silent"];
const service = ["running", "degraded", "stopping"];
const phase = ["idle", "tracking", "holding", "returning", "landing", "stopped",
  "starting", "taking off"];
const result = ["none", "accepted", "refused: too late", "refused: repeated",
  "refused: not from this phase", "refused: somebody else has control",
  "refused: stamped in the future", "refused: no proof that it comes from who has control",
  "refused: it could not be written down", "refused: these are no bounds",
  "acts, and is being written down", "accepted, but a restart would forget it",
  "refused: nobody of that number is there", "refused: not safe, or no framing",
  "refused: this place is outside of the fence"];
const command = ["start", "hold", "resume", "return", "land", "stop", "take control",
  "give control back", "take off", "set bounds", "follow a person", "set the framing",
  "set the return place"];
const choice = ["nobody is followed yet", "following", "in doubt", "searching", "lost"];
const trust = ["itself", "believed", "aligned", "not aligned", "a liar"];
const level = ["ok", "warning", "error", "stale"];
const battery = ["ok", "low", "critical", "emergency", "failed"];

const planReason = [
  "all is well",
  "no person has been seen yet",
  "the person was lost",
  "an input is too old",
  "the free space along the way is too tight",
  "the optimiser did not converge",
  "the trajectory broke the vehicle's limits",
  "the trajectory came too near an obstacle",
  "the trajectory did not continue the one that is flown",
  "the trajectory's stop would not be safe",
  "the trajectory came too near the person",
];
const gateReason = [
  "all is well",
  "no plan has come yet",
  "plans have ceased to come",
  "the last plan has come to its end",
  "the planner itself asks to stand still",
  "the vehicle is far from where it was told to be",
  "the vehicle's state has ceased to come",
  "nothing is heard from the autopilot",
  "the autopilot is not in offboard mode",
  "an operator's order",
  "the odometry jumps",
  "the odometry is frozen",
  "the odometry disagrees with its own velocity",
  "an obstacle is in the way",
  "somebody is in the way",
  "the vehicle is outside of its fence",
  "the vehicle is outside of its altitudes",
  "the battery is at its reserve",
  "nothing is heard from the operator",
  "the images are frozen, dark or covered",
];

const missionEnd = [
  "",
  "the pilot took over",
  "the pilot moved the sticks",
  "another mode was chosen",
  "the vehicle was disarmed",
  "the autopilot's failsafe acts",
  "the flight was terminated",
  "the autopilot refused",
  "the autopilot did not answer",
  "the autopilot accepted, and did nothing",
  "target, map, plan or autopilot did not come in time",
  "done",
  "the order could not be written down",
  "outside of what may be flown in",
  "the battery is at its reserve",
  "nothing is heard from the operator",
];

const from = (words: string[]) => (index: number): string => t(words[index] ?? said("unknown"));

/** All of them, for whoever translates. */
export const allWords = [track, prediction, plan, search, mode, service, phase, result, command,
  choice, trust, level, battery, planReason, gateReason, missionEnd].flat().filter((word) => word !== "");

export const trackWord = from(track);
export const predictionWord = from(prediction);
export const planWord = from(plan);
export const searchWord = from(search);
export const modeWord = from(mode);
export const serviceWord = from(service);
export const phaseWord = from(phase);
export const resultWord = from(result);
export const commandWord = from(command);
export const choiceWord = from(choice);
export const trustWord = from(trust);
export const levelWord = from(level);
export const batteryWord = from(battery);
export const explainPlan = from(planReason);
export const explainGate = from(gateReason);
export const explainEnd = from(missionEnd);

export const Mode = { track: 0, coast: 1, hover: 2, brake: 3, silent: 4 } as const;
export const Track = { none: 0, tracking: 1, coasting: 2, lost: 3 } as const;
export const PlanState = { none: 0, fresh: 1, kept: 2, search: 3, hold: 4 } as const;
export const ServiceState = { running: 0, degraded: 1, stopping: 2 } as const;
/** A lease is renewed by an order every second. */
export const leaseCommand = 6;
export const Result = { accepted: 1, pending: 10, acceptedUnwritten: 11 } as const;
export const personKind = 0;
export const Choice = { waiting: 0, following: 1, doubtful: 2, searching: 3, lost: 4 } as const;
export const Trust = { unaligned: 3, liar: 4 } as const;
export const GateReason = { none: 0, mission: 9, planHolds: 4 } as const;

/** Reasons of the gate say themselves that they refuse. */
export function outcome(result: string, reason: string): string {
  return !reason || reason.startsWith(result) ? reason || result : `${result}: ${reason}`;
}

export const severalPeople = said("several people could be the one who is followed");

/** Perception's doubt, in its own words. */
export function saysSeveralPeople(health: { state: number; last_error: string }): boolean {
  return health.state === ServiceState.degraded && health.last_error.startsWith(severalPeople);
}
