// SPDX-License-Identifier: Apache-2.0
// Who commands, with which token; and the requests to the station.
import type { GroundMap } from "../ground/ground_map.ts";
import { setToken, token } from "../data/token.ts";
import type { Answer, Recording, StationStatus } from "../data/station.ts";

export type Command = "start" | "hold" | "resume" | "return" | "land" | "stop" |
  "take_off" | "follow" | "framing" | "bounds" | "return_place";
/** What an order says besides its name. null: as the parameters have it, or no bound. */
export type OrderDetails =
  | { person_id: number }
  | { distance_m: number | null; height_m: number | null; bearing_rad: number | null;
      circling_radps: number }
  | { fence_m: [number, number][]; altitude_min_m: number | null; altitude_max_m: number | null }
  | { position_m: [number, number] };
export type LeaseAction = "take" | "release" | "hand_over";

const nameKey = "foretrack.operator";

export class Operator {
  private name_ = localStorage.getItem(nameKey) ?? "";

  get name(): string {
    return this.name_.trim();
  }
  /** As it stands in the field. */
  get typed(): string {
    return this.name_;
  }
  set name(name: string) {
    this.name_ = name.replace(/[^\w\-. ]/g, "").trimStart().slice(0, 32); // what the station takes
    localStorage.setItem(nameKey, this.name_);
  }
  get token(): string {
    return token();
  }
  setToken(typed: string): void {
    setToken(typed);
  }
  headers(): Record<string, string> {
    return this.token ? { Authorization: `Bearer ${this.token}` } : {};
  }

  lease(vehicle: string, action: LeaseAction, to?: string): Promise<Answer> {
    return this.post("lease", { vehicle, operator: this.name, action, ...(to ? { to } : {}) });
  }
  command(vehicle: string, command: Command, details?: OrderDetails): Promise<Answer> {
    return this.post("command", { vehicle, command, operator: this.name || "unnamed", ...details });
  }
  record(action: "start" | "stop"): Promise<Answer> {
    return this.post("record", { action });
  }
  async recordings(): Promise<Recording[]> {
    const answer = await fetch("api/recordings", { headers: this.headers() });
    if (!answer.ok) throw new Error(`HTTP ${answer.status}`);
    const body = (await answer.json()) as Recording[] | { recordings: Recording[] };
    return Array.isArray(body) ? body : body.recordings;
  }
  async status(): Promise<StationStatus> {
    const answer = await fetch("api/status", { headers: this.headers() });
    return (await answer.json()) as StationStatus;
  }

  /** null: the station has none, or a token is missing. */
  async groundMap(): Promise<GroundMap | null> {
    const answer = await fetch("map.json", { headers: this.headers() }).catch(() => null);
    return answer?.ok ? ((await answer.json()) as GroundMap | null) : null;
  }

  /** Never throws: what fails is a refusal with a reason. */
  private async post(path: string, body: object): Promise<Answer> {
    try {
      const answer = await fetch(`api/${path}`, {
        method: "POST",
        headers: { "Content-Type": "application/json", ...this.headers() },
        body: JSON.stringify(body),
        signal: AbortSignal.timeout(5000),
      });
      const said = (await answer.json().catch(() => null)) as Answer | null;
      return said ?? { ok: answer.ok, reason: `HTTP ${answer.status}` };
    } catch (error) {
      return { ok: false, reason: `the station does not answer: ${(error as Error).message}` };
    }
  }
}
