// SPDX-License-Identifier: Apache-2.0
// probe.mjs URL SECONDS [SUBPROTOCOL]: connects as Foxglove does, subscribes to everything and prints, as
// JSON, what came on each topic, with the last sample of each decoded.
import foxglove from "@foxglove/ws-protocol";
import WebSocket from "ws";

import { decoder } from "./decode.mjs";

const { FoxgloveClient } = foxglove;
const [url, seconds = "3", subprotocol = FoxgloveClient.SUPPORTED_SUBPROTOCOL] = process.argv.slice(2);
const report = { server: null, topics: {}, status: [], errors: [], publishers: {}, subscribers: {} };
const bySubscription = new Map();

const socket = new WebSocket(url, [subprotocol]);
const client = new FoxgloveClient({ ws: socket });
client.on("error", (error) => report.errors.push(String(error)));
client.on("serverInfo", (info) => (report.server = info));
client.on("open", () => client.subscribeConnectionGraph());
client.on("connectionGraphUpdate", ({ publishedTopics, subscribedTopics, removedTopics }) => {
  for (const { name, publisherIds } of publishedTopics) report.publishers[name] = publisherIds;
  for (const { name, subscriberIds } of subscribedTopics) report.subscribers[name] = subscriberIds;
  for (const name of removedTopics) delete report.publishers[name], delete report.subscribers[name];
});
client.on("status", (status) => report.status.push(status.message));
client.on("advertise", (channels) => {
  for (const channel of channels) {
    const topic = { type: channel.schemaName, schemaEncoding: channel.schemaEncoding, samples: 0, bytes: 0 };
    report.topics[channel.topic] = topic;
    try {
      topic.decode = decoder(channel);
    } catch (error) {
      topic.error = String(error);
    }
    bySubscription.set(client.subscribe(channel.id), topic);
  }
});
client.on("message", ({ subscriptionId, timestamp, data }) => {
  const topic = bySubscription.get(subscriptionId);
  topic.samples += 1;
  topic.bytes += data.byteLength;
  topic.logTime = Number(timestamp) / 1e9;
  try {
    if (topic.decode) topic.last = topic.decode(data);
  } catch (error) {
    topic.error = String(error);
  }
});

setTimeout(() => {
  report.protocol = socket.protocol;
  const text = JSON.stringify(report, (key, value) => {
    if (typeof value === "bigint") return Number(value);
    if (ArrayBuffer.isView(value)) return value.length > 64 ? `${value.length} items` : Array.from(value);
    return value;
  });
  process.stdout.write(text + "\n", () => process.exit(report.errors.length > 0 ? 1 : 0));
}, Number(seconds) * 1000);
