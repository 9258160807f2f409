// SPDX-License-Identifier: Apache-2.0
// The store: folds samples, the passing of time and the link's state into State. It reads no clock,
// so the same inputs give the same state, live or replayed. State is changed in place: thousands of
// samples come a second.
import type { DiagnosticArray, ServiceHealth, TransformMessage } from "../data/messages.ts";
import type { Sample } from "../data/sample.ts";
import type { StationStatus } from "../data/station.ts";
import { lasting, ownerOf } from "../data/topics.ts";
import { t } from "../ui/words.ts";
import { acknowledge, note } from "./alarms.ts";
import { folders } from "./fold_vehicle.ts";
import { makeVehicle, type State, type Vehicle } from "./state.ts";
import { compareStations, hearStation, watchTime } from "./watch.ts";

export type Input =
  | { kind: "sample"; sample: Sample }
  | { kind: "time"; now_s: number }
  | { kind: "link"; open: boolean; reason: string; now_s: number }
  | { kind: "acknowledge"; key: string }
  | { kind: "problem"; text: string };

export function reduce(state: State, input: Input): State {
  switch (input.kind) {
    case "sample":
      foldSample(state, input.sample);
      break;
    case "time":
      state.now_s = input.now_s;
      measureTraffic(state);
      watchTime(state);
      break;
    case "link":
      state.now_s = input.now_s;
      foldLink(state, input.open, input.reason);
      break;
    case "acknowledge":
      acknowledge(state, input.key);
      break;
    case "problem":
      note(state, "", "warning", input.text);
      break;
  }
  return state;
}

function foldLink(state: State, open: boolean, reason: string): void {
  if (state.link.open !== open)
    note(state, "", open ? "info" : "alarm",
      open ? t("connected to the station")
        : t("no connection to the station: {why}", { why: reason }));
  state.link = { open, reason, since_s: state.now_s };
}

function foldSample(state: State, sample: Sample): void {
  state.now_s = Math.max(state.now_s, sample.time_s);
  count(state, sample);
  if (sample.name === "station/status") return hearStatus(state, sample);
  if (sample.name === "diagnostics") return hearDiagnostics(state, sample);
  if (sample.name === "tf_static") return hearMounts(state, sample);
  const vehicle = vehicleOf(state, sample);
  if (!vehicle) return;
  if (!lasting.includes(sample.name)) vehicle.heard_s = sample.time_s; // those may be latched, and old
  if (sample.message === undefined) return;
  folders[sample.name]?.(state, vehicle, sample); // sees the last message beside the new one
  if (sample.name === "health") {
    const message = sample.message as ServiceHealth;
    vehicle.services.set(message.service, { message, time_s: sample.time_s });
  } else {
    (vehicle.latest as Record<string, unknown>)[sample.name] =
      { message: sample.message, time_s: sample.time_s };
  }
}

function hearStatus(state: State, sample: Sample): void {
  if (sample.message === undefined) return;
  const message = sample.message as StationStatus;
  if (state.station) compareStations(state, state.station.message, message);
  state.station = { message, time_s: sample.time_s };
  hearStation(state, message);
}

// A vehicle is what writes under a name of its own; the autopilot's topics go to its owner.
function vehicleOf(state: State, sample: Sample): Vehicle | undefined {
  const names = [...state.vehicles.keys()];
  if (sample.name.startsWith("fmu/")) {
    const owner = ownerOf(sample.vehicle, names);
    return owner === undefined ? undefined : state.vehicles.get(owner);
  }
  if (sample.vehicle === "") return undefined;
  let vehicle = state.vehicles.get(sample.vehicle);
  if (!vehicle) {
    vehicle = makeVehicle(sample.vehicle, names.length);
    state.vehicles.set(sample.vehicle, vehicle);
    note(state, sample.vehicle, "info", t("first heard of"), sample.time_s);
  }
  return vehicle;
}

function count(state: State, sample: Sample): void {
  const { topic, vehicle, name, type, time_s, bytes } = sample;
  let traffic = state.traffic.get(topic);
  if (!traffic) {
    traffic = { topic, vehicle, name, type, count: 0, bytes: 0, total: 0, heard_s: time_s,
      rate_hz: 0, bytes_s: 0, mark: { time_s, count: 0, total: 0 } };
    state.traffic.set(topic, traffic);
  }
  traffic.count++;
  traffic.total += bytes;
  traffic.bytes = bytes;
  traffic.heard_s = time_s;
}

function measureTraffic(state: State): void {
  for (const t of state.traffic.values()) {
    const elapsed_s = state.now_s - t.mark.time_s;
    if (elapsed_s < 2) continue;
    t.rate_hz = (t.count - t.mark.count) / elapsed_s;
    t.bytes_s = (t.total - t.mark.total) / elapsed_s;
    t.mark = { time_s: state.now_s, count: t.count, total: t.total };
  }
}

function hearMounts(state: State, sample: Sample): void {
  const message = sample.message as TransformMessage | undefined;
  for (const transform of message?.transforms ?? [])
    state.mounts.set(transform.child_frame_id, transform);
}

function hearDiagnostics(state: State, sample: Sample): void {
  const array = sample.message as DiagnosticArray | undefined;
  for (const message of array?.status ?? [])
    state.diagnostics.set(message.name, { message, time_s: sample.time_s });
}
