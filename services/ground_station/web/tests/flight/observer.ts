// SPDX-License-Identifier: Apache-2.0
// What the topics say, heard beside the page by the official client.
import { FoxgloveClient, type IWebSocket } from "@foxglove/ws-protocol";
import WebSocket from "ws";

import { makeDecoder, type Decoder } from "../../src/data/decode.ts";
import type { Channel } from "../../src/data/sample.ts";

interface Heard { at_ms: number; message: unknown }

export class Observer {
  private readonly client: FoxgloveClient;
  private readonly heard = new Map<string, Heard[]>();
  private readonly decoders = new Map<number, { topic: string; decode: Decoder }>();
  private ended = "";

  constructor(url: string) {
    const socket = new WebSocket(`${url.replace(/^http/, "ws").replace(/[#?].*$/, "")}ws`,
      ["foxglove.websocket.v1"]);
    this.client = new FoxgloveClient({ ws: socket as unknown as IWebSocket });
    this.client.on("error", (error) => (this.ended ||= String(error)));
    socket.on("close", (code, why) => (this.ended ||= `closed: ${code} ${why.toString()}`));
    this.client.on("advertise", (channels) => channels.forEach((c) => {
      if (/image|octomap|map\/local/.test(c.topic)) return;
      const channel = { ...c, schemaEncoding: c.schemaEncoding ?? "" } as Channel;
      const decode = makeDecoder(channel);
      this.decoders.set(this.client.subscribe(c.id), { topic: c.topic, decode });
      if (!this.heard.has(c.topic)) this.heard.set(c.topic, []);
    }));
    this.client.on("message", ({ subscriptionId, data }) => {
      const of = this.decoders.get(subscriptionId);
      if (!of) return;
      const bytes = new Uint8Array(data.buffer, data.byteOffset, data.byteLength);
      this.heard.get(of.topic)!.push({ at_ms: performance.now(), message: of.decode(bytes) });
    });
  }

  topics(): string[] {
    return [...this.heard.keys()];
  }

  /** Of the last so many seconds, newest last. */
  last<T>(topic: string, seconds = 5): T[] {
    if (this.ended) throw new Error(`the observer hears nothing more: ${this.ended}`);
    const from_ms = performance.now() - 1000 * seconds;
    return (this.heard.get(topic) ?? []).filter((h) => h.at_ms >= from_ms)
      .map((h) => h.message as T);
  }

  rate_hz(topic: string, seconds = 4): number {
    return this.last(topic, seconds).length / seconds;
  }

  close(): void {
    this.client.close();
  }
}
