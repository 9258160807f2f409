// SPDX-License-Identifier: Apache-2.0
// The keyboard. Keys do nothing while a field is being typed in.
import type { Session } from "./session.ts";
import { said } from "./words.ts";

export interface KeyActions {
  view(view: "orbit" | "follow" | "top"): void;
  cut(): void;
  tab(index: number): void;
  picture(): void;
  bookmark(): void;
  stop(pressed: boolean): void;
  help(): void;
}

export const keyHelp: [string, string][] = [
  [said("hold S"), said("STOP the chosen vehicle")],
  ["[ ]", said("previous, next vehicle")],
  ["O F T", said("orbit, follow, top view")],
  ["W", said("cut walls low, or not")],
  ["A", said("acknowledge all alarms")],
  ["1 … 6", said("events, diagnostics, topics, recordings, control, fly")],
  ["P", said("picture inset, large, hidden")],
  ["M", said("sound of alarms, or none")],
  ["+ −", said("longer, shorter plots")],
  [said("Space"), said("replay: play, pause")],
  ["← →", said("replay: 1 s back, on; with Shift 10 s")],
  [", .", said("replay: a step of 0.1 s back, on")],
  ["B", said("replay: bookmark")],
  ["?", said("this help, and the language")],
];

export const spans_s = [10, 30, 60, 120];

export function changeSpan(session: Session, by: number): void {
  const at = spans_s.indexOf(session.span_s) + by;
  session.span_s = spans_s[Math.min(Math.max(at, 0), spans_s.length - 1)]!;
  session.changed();
}

function nextVehicle(session: Session, by: number): void {
  const names = session.vehicles.map((vehicle) => vehicle.name);
  if (names.length === 0) return;
  const at = names.indexOf(session.vehicle?.name ?? "");
  session.choose(names[(at + by + names.length) % names.length]!);
}

function press(key: string, shift: boolean, session: Session, actions: KeyActions): boolean {
  const { replay } = session;
  const jump_s = shift ? 10 : 1;
  const keys: Record<string, () => void> = {
    "[": () => nextVehicle(session, -1),
    "]": () => nextVehicle(session, 1),
    "o": () => actions.view("orbit"),
    "f": () => actions.view("follow"),
    "t": () => actions.view("top"),
    "w": () => actions.cut(),
    "p": () => actions.picture(),
    "m": () => session.sound.toggle(),
    "a": () => session.tell({ kind: "acknowledge", key: "all" }),
    "+": () => changeSpan(session, 1),
    "=": () => changeSpan(session, 1),
    "-": () => changeSpan(session, -1),
    "?": () => actions.help(),
    "s": () => actions.stop(true),
  };
  for (let i = 1; i <= 6; i++) keys[`${i}`] = () => actions.tab(i - 1);
  if (replay)
    Object.assign(keys, {
      " ": () => replay.play(!replay.clock.playing),
      "arrowleft": () => replay.seek(replay.time_s() - jump_s),
      "arrowright": () => replay.seek(replay.time_s() + jump_s),
      ",": () => replay.step(-0.1),
      ".": () => replay.step(0.1),
      "b": () => actions.bookmark(),
    });
  const action = keys[key.toLowerCase()];
  action?.();
  if (action) session.changed();
  return action !== undefined;
}

function isTyping(target: EventTarget | null): boolean {
  return target instanceof HTMLElement &&
    target.matches("input:not([type=range]), select, textarea");
}

export function listenToKeys(session: Session, actions: KeyActions): () => void {
  const down = (event: KeyboardEvent): void => {
    if (event.repeat || event.ctrlKey || event.altKey || event.metaKey) return;
    if (isTyping(event.target)) return;
    if (event.key === " " && event.target instanceof HTMLButtonElement) return;
    if (press(event.key, event.shiftKey, session, actions)) event.preventDefault();
  };
  const up = (event: KeyboardEvent): void => {
    if (event.key.toLowerCase() === "s") actions.stop(false);
  };
  const blur = (): void => actions.stop(false);
  window.addEventListener("keydown", down);
  window.addEventListener("keyup", up);
  window.addEventListener("blur", blur);
  return () => {
    window.removeEventListener("keydown", down);
    window.removeEventListener("keyup", up);
    window.removeEventListener("blur", blur);
  };
}
