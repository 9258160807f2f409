// SPDX-License-Identifier: Apache-2.0
// Bytes to messages, by the schema that the channel carries.
import { parseIDL } from "@foxglove/omgidl-parser";
import { MessageReader as IdlReader } from "@foxglove/omgidl-serialization";
import { parse as parseRos } from "@foxglove/rosmsg";
import { MessageReader as RosReader } from "@foxglove/rosmsg2-serialization";

import type { Channel } from "./sample.ts";

export type Decoder = (data: Uint8Array) => unknown;

const utf8 = new TextDecoder();

/** Throws what is wrong with the schema. */
export function makeDecoder(channel: Channel): Decoder {
  if (channel.encoding === "json") return (data) => JSON.parse(utf8.decode(data)) as unknown;
  if (channel.encoding !== "cdr") throw new Error(`unknown encoding ${channel.encoding}`);
  if (channel.schemaEncoding === "omgidl") {
    const reader = new IdlReader(idlName(channel.schemaName), parseIDL(channel.schema));
    return (data) => reader.readMessage(data);
  }
  if (channel.schemaEncoding === "ros2msg" || channel.schemaEncoding === "") {
    const reader = new RosReader(parseRos(channel.schema, { ros2: true }));
    return (data) => reader.readMessage(data);
  }
  throw new Error(`unknown schema encoding ${channel.schemaEncoding}`);
}

/** pkg/msg/Name, pkg::msg::dds_::Name_ and pkg::msg::Name are one type. */
export function idlName(name: string): string {
  return name.replaceAll("/", "::").replace("::dds_::", "::").replace(/_$/, "");
}

/** One decoder a schema, made when first used; a schema that cannot be read is reported once. */
export class Decoders {
  private readonly ofChannel = new WeakMap<Channel, Decoder | null>();
  private readonly ofSchema = new Map<string, Decoder | null>();
  constructor(private readonly report: (problem: string) => void = () => {}) {}

  /** Whether its schema was read. */
  knows(channel: Channel): boolean {
    return this.ofChannel.has(channel);
  }

  decode(channel: Channel, data: Uint8Array): unknown {
    let decoder = this.ofChannel.get(channel);
    if (decoder === undefined) {
      decoder = this.shared(channel);
      this.ofChannel.set(channel, decoder);
    }
    try {
      return decoder?.(data);
    } catch (error) {
      this.report(`${channel.topic}: a message cannot be read: ${(error as Error).message}`);
      return undefined;
    }
  }

  private shared(channel: Channel): Decoder | null {
    const { encoding, schemaName, schemaEncoding, schema } = channel;
    const key = [encoding, schemaName, schemaEncoding, schema].join("\n");
    let decoder = this.ofSchema.get(key);
    if (decoder === undefined) {
      decoder = this.make(channel);
      this.ofSchema.set(key, decoder);
    }
    return decoder;
  }

  private make(channel: Channel): Decoder | null {
    try {
      return makeDecoder(channel);
    } catch (error) {
      this.report(`${channel.topic}: schema ${channel.schemaName} cannot be read: ` +
        (error as Error).message);
      return null;
    }
  }
}
