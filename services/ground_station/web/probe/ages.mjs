// SPDX-License-Identifier: Apache-2.0
// ages.mjs URL SECONDS [TOKEN]: a client that subscribes to what the page does. Prints, as JSON, how old samples
// were on arrival (both clocks are this machine's) and the longest time without any, of each topic and of all.
import WebSocket from "ws";

const [url, seconds, token] = process.argv.slice(2);
const wantedTopics = new RegExp("/(odometry|target/(state|observation|intention|prediction)|plan/trajectory|" +
  "safety/state|mission/command|health|map/points|diagnostics|fmu/out/battery_status|station/status)$");
const topics = new Map();
const bySubscription = new Map();
let closed = "";

const socket = new WebSocket(token ? `${url}?token=${token}` : url, ["foxglove.websocket.v1"]);
let bytes = 0;
const all = { count: 0, last: 0, gap: 0, ages: [] };
let from_ms = Infinity;

function note(of, age_ms, now_ms) {
  if (of.last > 0) of.gap = Math.max(of.gap, now_ms - of.last);
  of.last = now_ms;
  of.count += 1;
  of.ages.push(age_ms);
}

socket.on("message", (data, isBinary) => {
  const now_ms = Date.now();
  if (isBinary) {
    if (now_ms < from_ms) return;
    bytes += data.length;
    const age_ms = now_ms - Number(data.readBigUInt64LE(5)) / 1e6;
    note(bySubscription.get(data.readUInt32LE(1)), age_ms, now_ms);
    note(all, age_ms, now_ms);
    return;
  }
  const message = JSON.parse(data);
  if (message.op !== "advertise") return;
  const wanted = message.channels.filter(({ topic }) => wantedTopics.test(topic));
  socket.send(JSON.stringify({ op: "subscribe", subscriptions: wanted.map(({ id, topic }) => {
    const of = { count: 0, last: 0, gap: 0, ages: [] };
    topics.set(topic, of);
    bySubscription.set(id, of);
    return { id, channelId: id };
  }) }));
});
socket.on("close", (code, reason) => (closed = `${code} ${reason}`));
socket.on("error", (error) => console.error(String(error)));

function summary({ count, gap, ages, last }, now_ms) {
  ages.sort((a, b) => a - b);
  const at = (q) => Math.round(ages[Math.floor(q * (ages.length - 1))] ?? -1);
  return { count, p50_ms: at(0.5), p95_ms: at(0.95), max_ms: at(1),
    longest_gap_ms: Math.round(Math.max(gap, now_ms - last)) };
}

await new Promise((resolve) => setTimeout(resolve, 4000)); // to connect, and for what is latched
from_ms = Date.now();
await new Promise((resolve) => setTimeout(resolve, Number(seconds) * 1000));
const now_ms = Date.now();
console.log(JSON.stringify({ closed, kb_s: Math.round(bytes / Number(seconds) / 100) / 10,
  all: summary(all, now_ms),
  topics: Object.fromEntries([...topics].filter(([, of]) => of.count > 0)
    .map(([name, of]) => [name, summary(of, now_ms)])) }));
process.exit(0);
