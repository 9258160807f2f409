// SPDX-License-Identifier: Apache-2.0
// A recording, whole or cut off in the middle.
import type { McapTypes } from "@mcap/core";
import { decompress } from "fzstd";

import type { Channel, RawSample } from "./sample.ts";

export interface Recording {
  readonly name: string;
  readonly begin_s: number; // log time
  readonly end_s: number;
  topics(): string[];
  /** In log time's order, from_s < time ≤ to_s. */
  read(from_s: number, to_s: number, cancelled: () => boolean): Promise<RawSample[]>;
  /** The last sample at or before a time of each topic that is sent seldom. */
  lastBefore(time_s: number): Promise<RawSample[]>;
}

export const fromNs = (ns: bigint): number => Number(ns / 1000n) / 1e6;
export const toNs = (s: number): bigint => BigInt(Math.round(s * 1e6)) * 1000n;

export const decompressHandlers: McapTypes.DecompressHandlers = {
  zstd: (data, size) => decompress(new Uint8Array(data), new Uint8Array(Number(size))),
};

export function channelOf(channel: McapTypes.TypedMcapRecords["Channel"],
                          schema: McapTypes.TypedMcapRecords["Schema"] | undefined): Channel {
  return { topic: channel.topic, encoding: channel.messageEncoding,
    schemaName: schema?.name ?? "", schemaEncoding: schema?.encoding ?? "",
    schema: schema ? new TextDecoder().decode(schema.data) : "" };
}
