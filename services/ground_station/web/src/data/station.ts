// SPDX-License-Identifier: Apache-2.0
// What the station says of itself: /station/status and GET /api/status.

export interface StationVehicle {
  name: string;
  seen_s_ago: number | null;
  clock_ahead_s?: number | null; // of the station's; null: simulated, or not known
  lease: { operator: string; expires_s: number } | null;
  last_command: {
    id: number; command: string; operator: string; result: string; reason: string;
  } | null;
  unconfirmed?: { command: string; operator: string; still_sent: boolean } | null;
  orders_refused?: string | null; // why the station may not order it
}

export interface StationTopic {
  topic: string;
  type: string;
  vehicle: string;
  writers: number;
  readers: number;
  rate_hz: number;
  bytes_s: number;
  age_s: number | null; // null: nothing came yet
  limited: boolean;
  resting?: boolean; // nobody asks for it, so the station does not read it
  qos_mismatch: boolean | number;
  foreign_type: string | null;
}

export interface StationClient {
  id: number;
  address: string;
  subscriptions: number;
  bytes_s: number;
  waiting_bytes: number;
  dropped: number;
}

export interface StationStatus {
  server: {
    version: string; uptime_s: number; clients: number; control_enabled: boolean;
    needs_token: boolean;
  };
  vehicles: StationVehicle[];
  recording: {
    active: boolean; file: string; bytes: number; seconds: number; lost?: number;
  } | null;
  recording_fault?: string | null;
  warnings?: string[]; // of the bus; stations before 0.2 do not tell
  topics: StationTopic[];
  clients: StationClient[];
}

/** Not answered: the safety gate kept silent, so that nobody knows whether the order was obeyed. */
export interface Answer { ok: boolean; reason: string; answered?: boolean }
/** A recording on the station's disk. */
export interface Recording { file: string; bytes: number; [more: string]: unknown }
