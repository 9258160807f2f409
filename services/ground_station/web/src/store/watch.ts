// SPDX-License-Identifier: Apache-2.0
// Conditions that come with the passing of time, and with the station's own report.
import type { StationStatus } from "../data/station.ts";
import { outcome } from "../data/words.ts";
import { t } from "../ui/words.ts";
import { hold, note } from "./alarms.ts";
import { age_s, type State } from "./state.ts";

export const stale_s = 1.0; // state topics come at 20 Hz and more
const gateSilent_s = 2.0;
export const gone_s = 2.5; // a vehicle that says nothing at all
export const silent_s = 3.5; // a service; its health comes once a second

export function watchTime(state: State): void {
  for (const vehicle of state.vehicles.values()) {
    const quiet_s = state.now_s - vehicle.heard_s;
    const gone = Number.isFinite(vehicle.heard_s) && quiet_s > gone_s;
    hold(state, vehicle.name, "silent", gone, "alarm",
      t("nothing heard for {seconds} s", { seconds: quiet_s.toFixed(0) }));
    const gate_s = age_s(state, vehicle.latest["safety/state"]);
    hold(state, vehicle.name, "gate silent", !gone && gate_s > gateSilent_s, "alarm",
      t("the safety gate is silent for {seconds} s", { seconds: gate_s.toFixed(0) }));
    for (const [name, heard] of vehicle.services) {
      const service_s = age_s(state, heard);
      hold(state, vehicle.name, `service silent ${name}`, !gone && service_s > silent_s, "alarm",
        t("{service}: silent for {seconds} s", { service: name, seconds: service_s.toFixed(0) }));
    }
  }
}

// Each sentence is an alarm of its own; numbers in it may grow.
function hearWarnings(state: State, warnings: string[]): void {
  const kinds = new Map(warnings.map((text) => [`bus ${text.replace(/\d+/g, "")}`, text]));
  for (const [kind, text] of kinds) hold(state, "", kind, true, "alarm", text);
  for (const alarm of state.alarms.values())
    if (alarm.key.startsWith(" bus ") && !kinds.has(alarm.key.slice(1)))
      hold(state, "", alarm.key.slice(1), false, alarm.severity, alarm.text);
}

export function hearStation(state: State, status: StationStatus): void {
  const fault = status.recording_fault ?? "";
  hold(state, "", "recording", fault !== "", "alarm", fault);
  hearWarnings(state, status.warnings ?? []);
  for (const { name, orders_refused } of status.vehicles)
    hold(state, name, "orders refused", Boolean(orders_refused), "alarm", orders_refused ?? "");
  for (const { name, unconfirmed } of status.vehicles)
    hold(state, name, "order", Boolean(unconfirmed), "alarm",
      t("{order} of {who}: not confirmed by the safety gate, {so}", {
        order: unconfirmed?.command ?? "", who: unconfirmed?.operator ?? "",
        so: unconfirmed?.still_sent ? t("still being sent") : t("given up") }));
  for (const topic of status.topics) {
    hold(state, topic.vehicle ?? "", `qos ${topic.topic}`, Boolean(topic.qos_mismatch), "warning",
      t("{topic}: quality of service does not match", { topic: topic.topic }));
    hold(state, topic.vehicle ?? "", `foreign ${topic.topic}`, Boolean(topic.foreign_type),
      "warning", t("{topic}: a foreign type, {type}",
        { topic: topic.topic, type: topic.foreign_type ?? "" }));
  }
}

/** What changed from one report of the station to the next: refused orders, recording. */
export function compareStations(state: State, before: StationStatus, now: StationStatus): void {
  for (const vehicle of now.vehicles) {
    const was = before.vehicles.find((v) => v.name === vehicle.name);
    const command = vehicle.last_command;
    if (command && command.reason && command.id !== was?.last_command?.id)
      note(state, vehicle.name, "warning",
        `${command.command} of ${command.operator}: ${outcome(command.result, command.reason)}`);
  }
  const [was, is] = [before.recording?.active ?? false, now.recording?.active ?? false];
  if (was !== is)
    note(state, "", "info", is ? t("recording {file}", { file: now.recording?.file ?? "" }) : t("recording ended"));
}
