// SPDX-License-Identifier: Apache-2.0
// A message on its way from a source (the live link or a recording) to the store.

export interface Channel {
  topic: string;
  encoding: string; // "cdr" or "json"
  schemaName: string;
  schemaEncoding: string; // "omgidl", "ros2msg", "jsonschema" or ""
  schema: string;
}

export interface RawSample {
  channel: Channel;
  time_s: number; // log time: when the station took it from the bus, Unix time
  bytes: number;
  data: Uint8Array | null; // null: counted, but a newer one of its topic says it all
}

export interface Sample {
  topic: string; // as it is announced: "/uav1/target/state"
  vehicle: string; // "" for what no vehicle owns
  name: string; // "target/state"
  type: string;
  time_s: number;
  bytes: number;
  message: unknown; // undefined: not decoded
}
