// SPDX-License-Identifier: Apache-2.0
// load.mjs URL CLIENTS SECONDS [PATTERN]: so many clients subscribe to everything, or to the topics that
// fit; prints, as JSON, what they got and how old it was on arrival (both clocks are this machine's).
// SECONDS may be -: then "on" and "off" on standard input let them subscribe and unsubscribe, and its
// end is the end.
import { createInterface } from "node:readline";
import WebSocket from "ws";

const [, , url, clients, seconds, filter = "."] = process.argv;
const pattern = new RegExp(filter);
const ages = [];
let messages = 0;
let bytes = 0;
const closed = [];

class Client {
  channels = new Map(); // id → whether it is subscribed
  isOn = seconds !== "-";
  socket = new WebSocket(url, ["foxglove.websocket.v1"]);

  constructor() {
    this.socket.binaryType = "nodebuffer";
    this.socket.on("message", (data, isBinary) => isBinary ? hear(data) : this.read(data));
    this.socket.on("close", (code, reason) => closed.push(`${code} ${reason}`));
    this.socket.on("error", (error) => closed.push(String(error)));
  }
  read(data) {
    const message = JSON.parse(data);
    if (message.op === "unadvertise") message.channelIds.forEach((id) => this.channels.delete(id));
    if (message.op !== "advertise") return;
    for (const { id, topic } of message.channels)
      if (pattern.test(topic)) this.channels.set(id, false);
    if (this.isOn) this.turn(true);
  }
  turn(on) {
    this.isOn = on;
    const ids = [...this.channels].filter(([, subscribed]) => subscribed !== on).map(([id]) => id);
    for (const id of ids) this.channels.set(id, on);
    if (ids.length === 0) return;
    this.socket.send(JSON.stringify(on // a channel's subscription has its number
      ? { op: "subscribe", subscriptions: ids.map((id) => ({ id, channelId: id })) }
      : { op: "unsubscribe", subscriptionIds: ids }));
  }
}

function hear(data) {
  messages += 1;
  bytes += data.length;
  if (messages % 10 === 0) ages.push(Date.now() - Number(data.readBigUInt64LE(5)) / 1e6);
}

const all = Array.from({ length: Number(clients) }, () => new Client());
const pause = (duration_s) => new Promise((resolve) => setTimeout(resolve, 1000 * duration_s));
let subscribed_s = Number(seconds);
if (seconds === "-") {
  subscribed_s = 0;
  let since_ms = 0;
  for await (const word of createInterface({ input: process.stdin })) {
    if (word === "on") since_ms = performance.now();
    else subscribed_s += (performance.now() - since_ms) / 1000;
    all.forEach((client) => client.turn(word === "on"));
  }
} else {
  await pause(2); // what is latched has come
  messages = bytes = ages.length = 0;
  await pause(subscribed_s);
}
ages.sort((a, b) => a - b);
const quantile = (q) => Number(ages[Math.floor(q * (ages.length - 1))]?.toFixed(2));
console.log(JSON.stringify({
  clients: all.length,
  messages_s: Math.round(messages / subscribed_s),
  mb_s: Number((bytes / subscribed_s / 1e6).toFixed(2)),
  age_ms: { p50: quantile(0.5), p95: quantile(0.95), p99: quantile(0.99) },
  closed,
}));
all.forEach(({ socket }) => socket.terminate());
process.exit(0);
