// SPDX-License-Identifier: Apache-2.0
// An MCAP file with its index: only the parts that are shown are read.
import { type IReadable, McapIndexedReader } from "@mcap/core";

import { channelOf, decompressHandlers, fromNs, type Recording, toNs } from "./recording.ts";
import type { Channel, RawSample } from "./sample.ts";
import { lasting, partsOf, readingOf } from "./topics.ts";

export class IndexedRecording implements Recording {
  readonly begin_s: number;
  readonly end_s: number;
  private readonly channels = new Map<number, Channel>();

  private constructor(readonly name: string, private readonly reader: McapIndexedReader) {
    const chunks = reader.chunkIndexes.filter((c) => c.messageEndTime > 0n);
    this.begin_s = Math.min(...chunks.map((c) => fromNs(c.messageStartTime)));
    this.end_s = Math.max(...chunks.map((c) => fromNs(c.messageEndTime)));
    for (const [id, c] of reader.channelsById) {
      this.channels.set(id, channelOf(c, reader.schemasById.get(c.schemaId)));
    }
    if (!(this.end_s >= this.begin_s)) throw new Error(`${name} holds no messages`);
  }

  /** Throws if it is not an indexed MCAP file, or empty. */
  static async open(name: string, readable: IReadable): Promise<IndexedRecording> {
    const reader = await McapIndexedReader.Initialize({
      readable,
      messageIndexCacheSizeBytes: 16 << 20,
      decompressHandlers,
    });
    return new IndexedRecording(name, reader);
  }

  topics(): string[] {
    return [...this.channels.values()].map((c) => c.topic);
  }

  async read(from_s: number, to_s: number, cancelled: () => boolean): Promise<RawSample[]> {
    const samples: RawSample[] = [];
    const range = { startTime: toNs(from_s) + 1n, endTime: toNs(to_s) };
    if (range.endTime < range.startTime) return samples;
    for await (const m of this.reader.readMessages(range)) {
      if (cancelled()) break;
      const channel = this.channels.get(m.channelId);
      if (!channel) continue;
      const read = readingOf(channel.topic) !== undefined;
      samples.push({ channel, time_s: fromNs(m.logTime), bytes: m.data.byteLength,
        data: read ? m.data : null });
    }
    return samples;
  }

  async lastBefore(time_s: number): Promise<RawSample[]> {
    const samples: RawSample[] = [];
    for (const channel of this.channels.values()) {
      if (!lasting.includes(partsOf(channel.topic).name)) continue;
      const found = this.reader.readMessages({ topics: [channel.topic], endTime: toNs(time_s),
        reverse: true });
      for await (const m of found) {
        const { data, logTime } = m;
        samples.push({ channel, time_s: fromNs(logTime), bytes: data.byteLength, data });
        break;
      }
    }
    return samples;
  }
}
