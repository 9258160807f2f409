// A recording: an MCAP file on this machine, or on the station by range requests.
import { type IReadable, McapIndexedReader } from "@mcap/core";
import { decompress } from "fzstd";

import type { Channel, RawSample } from "./sample.ts";
import { lasting, partsOf, readingOf } from "./topics.ts";

const fromNs = (ns: bigint): number => Number(ns / 1000n) / 1e6;
const toNs = (s: number): bigint => BigInt(Math.round(s * 1e6)) * 1000n;

export class Recording {
  readonly begin_s: number;
  readonly end_s: number;
  private readonly channels = new Map<number, Channel>();

  private constructor(readonly name: string, private readonly reader: McapIndexedReader) {
    const chunks = reader.chunkIndexes.filter((c) => c.messageEndTime > 0n);
    this.begin_s = Math.min(...chunks.map((c) => fromNs(c.messageStartTime)));
    this.end_s = Math.max(...chunks.map((c) => fromNs(c.messageEndTime)));
    for (const [id, c] of reader.channelsById) {
      const schema = reader.schemasById.get(c.schemaId);
      this.channels.set(id, { topic: c.topic, encoding: c.messageEncoding,
        schemaName: schema?.name ?? "", schemaEncoding: schema?.encoding ?? "",
        schema: schema ? new TextDecoder().decode(schema.data) : "" });
    }
    if (!(this.end_s >= this.begin_s)) throw new Error(`${name} holds no messages`);
  }

  /** Throws if it is not an indexed MCAP file, or empty. */
  static async open(name: string, readable: IReadable): Promise<Recording> {
    const reader = await McapIndexedReader.Initialize({
      readable,
      messageIndexCacheSizeBytes: 16 << 20,
      decompressHandlers: {
        zstd: (data, size) => decompress(new Uint8Array(data), new Uint8Array(Number(size))),
      },
    });
    return new Recording(name, reader);
  }

  topics(): string[] {
    return [...this.channels.values()].map((c) => c.topic);
  }

  /** In log time's order, from_s < time ≤ to_s. */
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

  /** The last sample at or before a time of each topic that is sent seldom. */
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

export function readableOf(file: Blob): IReadable {
  return {
    size: async () => BigInt(file.size),
    read: async (offset, size) => {
      const end = Number(offset) + Number(size);
      return new Uint8Array(await file.slice(Number(offset), end).arrayBuffer());
    },
  };
}

/** Reads in blocks of 1 MiB and keeps the last ones, as an index is many small reads. */
export function readableAt(url: string, headers: Record<string, string> = {}): IReadable {
  const block = 1 << 20;
  const kept = new Map<number, Promise<Uint8Array>>();
  let size: number | null = null;
  const fetchRange = async (begin: number, end: number): Promise<Uint8Array> => {
    const Range = `bytes=${begin}-${end - 1}`;
    const answer = await fetch(url, { headers: { ...headers, Range } });
    if (answer.status !== 206) throw new Error(`${url}: HTTP ${answer.status}, 206 expected`);
    size ??= Number(/\/(\d+)$/.exec(answer.headers.get("Content-Range") ?? "")?.[1]);
    return new Uint8Array(await answer.arrayBuffer());
  };
  const blockAt = (index: number): Promise<Uint8Array> => {
    let data = kept.get(index);
    if (!data) {
      data = fetchRange(index * block, Math.min((index + 1) * block, size ?? Infinity));
      data.catch(() => kept.delete(index));
      kept.set(index, data);
      if (kept.size > 48) kept.delete(kept.keys().next().value!);
    }
    return data;
  };
  return {
    size: async () => {
      if (size === null) await fetchRange(0, 1);
      return BigInt(size!);
    },
    read: async (offset, length) => {
      const [begin, end] = [Number(offset), Number(offset + length)];
      const out = new Uint8Array(end - begin);
      for (let i = Math.floor(begin / block); i * block < end; i++) {
        const data = await blockAt(i);
        const from = Math.max(0, begin - i * block);
        const part = data.subarray(from, end - i * block);
        out.set(part, i * block + from - begin);
      }
      return out;
    },
  };
}
