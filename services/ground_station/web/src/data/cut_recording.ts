// SPDX-License-Identifier: Apache-2.0
// An MCAP file without its end, as a kill or a full disk leaves it, or one that is still written: it
// is read whole, up to its last good chunk.
import { type IReadable, McapStreamReader } from "@mcap/core";

import { channelOf, decompressHandlers, fromNs, type Recording } from "./recording.ts";
import type { Channel, RawSample } from "./sample.ts";
import { lasting, partsOf, readingOf } from "./topics.ts";

const part_bytes = 4n << 20n;

export class CutRecording implements Recording {
  readonly begin_s: number;
  readonly end_s: number;

  private constructor(readonly name: string, private readonly samples: RawSample[]) {
    if (samples.length === 0) throw new Error(`${name} holds no messages`);
    this.begin_s = samples[0]!.time_s;
    this.end_s = samples[samples.length - 1]!.time_s;
  }

  /** Throws if it is not an MCAP file, or holds nothing. */
  static async open(name: string, readable: IReadable): Promise<CutRecording> {
    const reader = new McapStreamReader({ decompressHandlers });
    const collector = new Collector();
    const size = await readable.size();
    for (let at = 0n; at < size; at += part_bytes) {
      const length = size - at < part_bytes ? size - at : part_bytes;
      reader.append(await readable.read(at, length));
      if (!takeAll(reader, collector)) break;
    }
    collector.samples.sort((a, b) => a.time_s - b.time_s);
    return new CutRecording(name, collector.samples);
  }

  topics(): string[] {
    return [...new Set(this.samples.map((s) => s.channel.topic))];
  }

  read(from_s: number, to_s: number): Promise<RawSample[]> {
    return Promise.resolve(this.samples.filter((s) => s.time_s > from_s && s.time_s <= to_s)
      .map((s) => ({ ...s })));
  }

  lastBefore(time_s: number): Promise<RawSample[]> {
    const last = new Map<string, RawSample>();
    for (const sample of this.samples) {
      if (sample.time_s > time_s) break;
      const { topic } = sample.channel;
      if (lasting.includes(partsOf(topic).name)) last.set(topic, { ...sample });
    }
    return Promise.resolve([...last.values()]);
  }
}

type RecordOf = NonNullable<ReturnType<McapStreamReader["nextRecord"]>>;

class Collector {
  readonly samples: RawSample[] = [];
  private readonly schemas = new Map<number, Extract<RecordOf, { type: "Schema" }>>();
  private readonly channels = new Map<number, Channel>();

  take(record: RecordOf): void {
    if (record.type === "Schema") this.schemas.set(record.id, record);
    if (record.type === "Channel" && !this.channels.has(record.id))
      this.channels.set(record.id, channelOf(record, this.schemas.get(record.schemaId)));
    if (record.type !== "Message") return;
    const channel = this.channels.get(record.channelId);
    if (!channel) return;
    const read = readingOf(channel.topic) !== undefined;
    this.samples.push({ channel, time_s: fromNs(record.logTime), bytes: record.data.byteLength,
      data: read ? record.data.slice() : null });
  }
}

// False: what follows cannot be read.
function takeAll(reader: McapStreamReader, collector: Collector): boolean {
  try {
    for (let record = reader.nextRecord(); record; record = reader.nextRecord())
      collector.take(record);
    return true;
  } catch {
    return false;
  }
}
