// SPDX-License-Identifier: Apache-2.0
// Events, and alarms that hold until their condition clears.
import { t } from "../ui/words.ts";
import type { Severity, State } from "./state.ts";

const maxEvents = 500;

export function note(state: State, vehicle: string, severity: Severity, text: string,
                     time_s = state.now_s): void {
  state.events.push({ id: state.nextEvent++, time_s, vehicle, severity, text });
  if (state.events.length > 1.2 * maxEvents) state.events = state.events.slice(-maxEvents);
}

/** Says whether the condition of this key holds; the first time it does is an event. */
export function hold(state: State, vehicle: string, kind: string, holds: boolean,
                     severity: Severity, text: string): void {
  const key = `${vehicle} ${kind}`;
  const alarm = state.alarms.get(key);
  if (!holds) {
    if (alarm && alarm.cleared_s === null) {
      alarm.cleared_s = state.now_s;
      note(state, vehicle, "info", t("over: {what}", { what: alarm.text }));
      if (alarm.acknowledged) state.alarms.delete(key);
    }
    return;
  }
  if (alarm && alarm.cleared_s === null) {
    if (rank(severity) > rank(alarm.severity)) alarm.acknowledged = false;
    alarm.text = text;
    alarm.severity = severity;
    return;
  }
  state.alarms.set(key, { key, vehicle, severity, text, since_s: state.now_s, cleared_s: null,
    acknowledged: false });
  note(state, vehicle, severity, text);
}

export function acknowledge(state: State, key: string | "all"): void {
  for (const alarm of [...state.alarms.values()]) {
    if (key !== "all" && alarm.key !== key) continue;
    alarm.acknowledged = true;
    if (alarm.cleared_s !== null) state.alarms.delete(alarm.key);
  }
}

export function rank(severity: Severity): number {
  return { info: 0, warning: 1, alarm: 2 }[severity];
}

/** Worst first, unacknowledged before acknowledged, then the newest. */
export function sortedAlarms(state: State) {
  return [...state.alarms.values()].sort((a, b) =>
    Number(a.acknowledged) - Number(b.acknowledged) || rank(b.severity) - rank(a.severity) ||
    b.since_s - a.since_s);
}
