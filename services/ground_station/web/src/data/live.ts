// SPDX-License-Identifier: Apache-2.0
// The live source: the station's WebSocket, by the official client of the Foxglove protocol.
import { type Channel as Announced, FoxgloveClient, type IWebSocket, type MessageData,
} from "@foxglove/ws-protocol";

import { SampleQueue } from "./queue.ts";
import type { Channel, RawSample } from "./sample.ts";
import { byName, isOnDemand, partsOf, readingOf, statusTopic } from "./topics.ts";

const protocols = ["foxglove.websocket.v1", "foxglove.sdk.v1"];
const retry_ms = 1000;
const jump_s = 5;
const deaf_s = 6; // the station speaks twice a second; so long without a word: it hangs

export class LiveLink {
  onProblem: (text: string) => void = () => {};
  private client: FoxgloveClient | null = null;
  private socket: WebSocket | null = null;
  private readonly queue = new SampleQueue();
  private readonly subscribed = new Map<number, { channel: Channel; channelId: number }>();
  private readonly offered = new Map<string, Announced>(); // on demand, by topic
  private wanted: readonly string[] = []; // of those
  private quietTicks = 0; // seconds without a word; counted, as a page that stood still is not deaf
  private closed = false;
  private isOffered = false;
  private tellOffer: () => void = () => {};
  private tellFirst: ((sample: RawSample) => void) | null = null;
  private listen: (open: boolean, reason: string) => void = () => {};
  private state: [open: boolean, reason: string] | null = null;
  private readonly timer: ReturnType<typeof setInterval>;
  /** Station's clock minus ours, by the quickest sample of late. */
  private ahead_s = 0;
  private aheadSince_ms = -Infinity;

  /** Of the station's topics those of this part are read. */
  constructor(private readonly url: () => string,
    private readonly isOfPart: (topic: string) => boolean) {
    this.connect();
    this.timer = setInterval(() => this.checkHearing(), 1000);
  }

  /** Calls back when it is known what can be read, and it is not read yet; at once if it is known. */
  onOffer(listen: () => void): void {
    this.tellOffer = listen;
    if (this.isOffered) listen();
  }

  /** Calls back with the next sample, which is taken in its turn all the same. */
  onFirst(listen: (sample: RawSample) => void): void {
    this.tellFirst = listen;
  }

  /** Calls back when the link opens or closes, and at once if it did. */
  onLink(listen: (open: boolean, reason: string) => void): void {
    this.listen = listen;
    if (this.state) listen(...this.state);
  }

  take(): RawSample[] {
    return this.queue.take();
  }

  /** Unix time on the station's clock. */
  now_s(): number {
    return Date.now() / 1000 + this.ahead_s;
  }

  /** Of the topics that are read on demand, those that are read from now on. */
  want(topics: readonly string[]): void {
    if (topics.join() === this.wanted.join()) return;
    this.wanted = topics;
    const read = new Set<string>();
    for (const [id, { channel }] of this.subscribed) {
      read.add(channel.topic);
      if (!isOnDemand(channel.topic) || topics.includes(channel.topic)) continue;
      this.client?.unsubscribe(id);
      this.subscribed.delete(id);
    }
    for (const topic of topics) {
      const offer = this.offered.get(topic);
      if (offer && this.client && !read.has(topic)) this.subscribe(this.client, offer);
    }
  }

  close(): void {
    this.closed = true;
    clearInterval(this.timer);
    this.client?.close();
  }

  private connect(): void {
    if (this.closed) return;
    this.subscribed.clear();
    this.offered.clear();
    this.quietTicks = 0;
    const socket = new WebSocket(this.url(), protocols);
    const client = new FoxgloveClient({ ws: socket as unknown as IWebSocket });
    this.socket = socket;
    this.client = client;
    client.on("open", () => this.tell(true, ""));
    client.on("error", () => {});
    client.on("close", (event) => this.onClose(client, event.reason || "closed"));
    client.on("status", (status) => {
      if (status.level > 0) this.onProblem(`station: ${status.message}`);
    });
    client.on("advertise", (channels) => {
      const mine = channels.filter((c) => this.isOfPart(c.topic));
      mine.filter((c) => isOnDemand(c.topic)).forEach((c) => this.offered.set(c.topic, c));
      this.isOffered = true;
      this.tellOffer();
      mine.forEach((c) => this.announce(client, c));
      this.spare(client);
    });
    client.on("unadvertise", (ids) => ids.forEach((id) => this.forget(id)));
    client.on("message", (message) => this.receive(message));
  }

  private onClose(client: FoxgloveClient, reason: string): void {
    if (client !== this.client) return;
    this.client = null;
    this.socket = null;
    if (this.closed) return;
    this.tell(false, reason);
    setTimeout(() => this.connect(), retry_ms);
  }

  private tell(open: boolean, reason: string): void {
    this.state = [open, reason];
    this.listen(open, reason);
  }

  private announce(client: FoxgloveClient, c: Announced): void {
    if (readingOf(c.topic) === undefined) return;
    const isWanted = !isOnDemand(c.topic) || this.wanted.includes(c.topic);
    const isRead = [...this.subscribed.values()].some((s) => s.channelId === c.id);
    if (isWanted && !isRead) this.subscribe(client, c);
  }

  private subscribe(client: FoxgloveClient, c: Announced): void {
    const channel: Channel = { topic: c.topic, encoding: c.encoding, schemaName: c.schemaName,
      schemaEncoding: c.schemaEncoding ?? (c.encoding === "cdr" ? "ros2msg" : ""),
      schema: c.schema };
    this.subscribed.set(client.subscribe(c.id), { channel, channelId: c.id });
  }

  // The station has already ended the subscription with the channel.
  private forget(channelId: number): void {
    for (const [id, of] of this.subscribed)
      if (of.channelId === channelId) this.subscribed.delete(id);
    for (const [topic, { id }] of this.offered)
      if (id === channelId) this.offered.delete(topic);
  }

  /** Vehicles of which something can be read on demand. */
  offering(): string[] {
    return [...this.offered.keys()].map((topic) => partsOf(topic).vehicle).sort(byName);
  }

  /** Whether there is such a topic, read or not. */
  offers(topic: string): boolean {
    return this.offered.has(topic);
  }

  // Of the map's two topics the page needs one, and a cloud once a second is the lighter.
  private spare(client: FoxgloveClient): void {
    const topics = new Set([...this.subscribed.values()].map((s) => s.channel.topic));
    for (const [id, { channel }] of this.subscribed) {
      const cloud = channel.topic.replace(/map\/local$/, "map/points");
      if (cloud === channel.topic || !topics.has(cloud)) continue;
      client.unsubscribe(id);
      this.subscribed.delete(id);
    }
  }

  private receive(message: MessageData): void {
    const of = this.subscribed.get(message.subscriptionId);
    this.quietTicks = 0;
    if (!of) return;
    const time_s = Number(message.timestamp / 1000n) / 1e6;
    if (of.channel.topic !== statusTopic) this.setClock(time_s);
    const view = message.data;
    const data = new Uint8Array(view.buffer, view.byteOffset, view.byteLength);
    const sample = { channel: of.channel, time_s, bytes: data.byteLength, data };
    this.queue.push(sample);
    this.tellFirst?.(sample);
    this.tellFirst = null;
  }

  // A station that serves a recording passes on its log times, and speaks of itself as of now.
  private setClock(time_s: number): void {
    const ahead_s = time_s - Date.now() / 1000;
    const old = performance.now() - this.aheadSince_ms > 10000;
    const jumped = ahead_s < this.ahead_s - jump_s; // it begins again, or a last value is old
    if (ahead_s <= this.ahead_s && !old && !jumped) return;
    this.ahead_s = ahead_s;
    this.aheadSince_ms = performance.now();
  }

  private checkHearing(): void {
    if (!this.client || ++this.quietTicks < deaf_s) return;
    const client = this.client;
    this.socket?.close();
    this.onClose(client, `no word for ${deaf_s} s`); // a dead link closes too late
  }
}
