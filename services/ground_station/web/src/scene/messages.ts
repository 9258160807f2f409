// SPDX-License-Identifier: Apache-2.0
// Between the page and the scene, which runs in a worker of its own: a picture that software draws
// would hold up the page's thread, and with it every sample.
import type { TrailPoint } from "../store/series.ts";
import type { GroundPiece } from "./ground.ts";
import type { Seen } from "./sketch.ts";

export type ViewKind = "orbit" | "follow" | "top";

/** What came of a vehicle since the last news: messages, and points of the trails. */
export interface VehicleNews {
  name: string;
  index: number;
  latest: Seen;
  trail: TrailPoint[];
  targetTrail: TrailPoint[];
}

export interface News {
  generation: number; // another one than before: all that was told is void
  now_s: number;
  chosen: string;
  vehicles: VehicleNews[];
}

/** Of a pointer's or wheel's event, what the camera's controls read. */
export interface InputEvent {
  type: string;
  pointerId: number;
  pointerType: string;
  button: number;
  clientX: number;
  clientY: number;
  pageX: number;
  pageY: number;
  deltaY: number;
  deltaMode: number;
  ctrlKey: boolean;
  metaKey: boolean;
  shiftKey: boolean;
}

/** Over a vehicle, or over one of the bodies around the chosen one. */
export interface Label { name: string; x: number; y: number; hidden: boolean; body?: BodyLabel }
export interface BodyLabel { id: number; person: boolean; followed: boolean; distance_m: number }

export interface Counts {
  fps: string;
  triangles: string;
  calls: string;
  script: string; // of a frame, ms
  busy: string; // the same until it is drawn
  ratio: string;
}

export type ToScene =
  | { kind: "begin"; canvas: OffscreenCanvas; ratio: number }
  | { kind: "size"; width: number; height: number }
  | { kind: "look"; view: ViewKind; cut: boolean }
  | { kind: "input"; event: InputEvent }
  | { kind: "ground"; pieces: GroundPiece[] }
  | { kind: "news"; news: News };

export type FromScene =
  | { kind: "ask" } // for news
  | { kind: "drawing"; labels: Label[]; placed: boolean }
  | { kind: "counted"; counts: Counts }
  | { kind: "failed"; reason: string };
