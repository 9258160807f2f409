// SPDX-License-Identifier: Apache-2.0
export interface StandIn {
  url: string;
  silent: Set<string>;
  band_m: [number, number];
  killed: Set<string>;
  mismatched: Set<string>;
  doubtful: Set<string>;
  unconfirmed: Map<string, { command: string; operator: string; still_sent: boolean }>;
  received: string[];
  bodies: Record<string, unknown>[];
  chosen: Map<string, { state: number; person_id: number }>;
  blind: Set<string>; // vehicles that send no pictures
  painted: number;
  videoFault: boolean; // what comes of the video cannot be decoded
  videoed: Map<string, number>;
  behind_s: number; // by which samples are older than now
  map: Map<string, Uint8Array | string>;
  recordings: Map<string, Uint8Array>;
  recording: { active: boolean; file: string; bytes: number; seconds: number } | null;
  clips: string[];
  close(): void;
}
export function startStandIn(options?: { port?: number; vehicles?: number; dist?: string;
  blind?: boolean; behind_s?: number; video?: boolean }): Promise<StandIn>;
