// SPDX-License-Identifier: Apache-2.0
// mcap.mjs FILE: reads a recording with MCAP's own library, from its index and as a stream, and
// prints what it found as JSON: { indexed, streamed, metadata, topics: { name: { samples, last } } }.
import { open } from "node:fs/promises";

import * as mcap from "@mcap/core";
import { decompress } from "fzstd";

import { decoder } from "./decode.mjs";

const file = await open(process.argv[2]);
const size = (await file.stat()).size;
const readable = {
  size: async () => BigInt(size),
  read: async (offset, length) => {
    const data = new Uint8Array(Number(length));
    const { bytesRead } = await file.read(data, 0, data.length, Number(offset));
    return data.subarray(0, bytesRead);
  },
};
const decompressHandlers = { zstd: (data, to) => decompress(data, new Uint8Array(Number(to))) };
const report = { topics: {}, metadata: {} };

function note(channel, schema, message, decoders) {
  const topic = (report.topics[channel.topic] ??= { samples: 0, schemaEncoding: schema?.encoding });
  topic.samples += 1;
  if (!decoders.has(channel.id)) {
    decoders.set(channel.id, decoder({
      encoding: channel.messageEncoding,
      schema: schema ? new TextDecoder().decode(schema.data) : "",
      schemaName: schema?.name,
      schemaEncoding: schema?.encoding,
    }));
  }
  const { buffer, byteOffset, byteLength } = message.data;
  topic.last = decoders.get(channel.id)?.(new DataView(buffer, byteOffset, byteLength));
}

try {
  const reader = await mcap.McapIndexedReader.Initialize({ readable, decompressHandlers });
  let messages = 0;
  let ordered = true;
  let before = 0n;
  const decoders = new Map();
  for await (const message of reader.readMessages()) {
    messages += 1;
    ordered &&= message.logTime >= before;
    before = message.logTime;
    const channel = reader.channelsById.get(message.channelId);
    note(channel, reader.schemasById.get(channel.schemaId), message, decoders);
  }
  for await (const record of reader.readMetadata()) report.metadata[record.name] = Object.fromEntries(record.metadata);
  report.indexed = {
    messages,
    ordered,
    counted: Number(reader.statistics.messageCount),
    chunks: reader.chunkIndexes.length,
  };
} catch (error) {
  report.indexed = { error: String(error) };
}

try {
  const stream = new mcap.McapStreamReader({ decompressHandlers, validateCrcs: true });
  let messages = 0;
  for (let offset = 0; offset < size; offset += 1 << 20) {
    stream.append(await readable.read(BigInt(offset), BigInt(Math.min(1 << 20, size - offset))));
    for (let record; (record = stream.nextRecord()); ) messages += record.type === "Message" ? 1 : 0;
  }
  report.streamed = { messages, done: stream.done() };
} catch (error) {
  report.streamed = { error: String(error) };
}

console.log(JSON.stringify(report, (key, value) => {
  if (typeof value === "bigint") return Number(value);
  if (ArrayBuffer.isView(value)) return value.length > 64 ? `${value.length} items` : Array.from(value);
  return value;
}));
