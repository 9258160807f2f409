// load.mjs URL CLIENTS SECONDS [PATTERN]: so many clients subscribe to everything, or to the topics that
// fit; prints, as JSON, what they got and how old it was on arrival (both clocks are this machine's).
import WebSocket from "ws";

const [url, clients, seconds] = [process.argv[2], Number(process.argv[3]), Number(process.argv[4])];
const pattern = new RegExp(process.argv[5] ?? ".");
const ages = [];
let messages = 0;
let bytes = 0;
const closed = [];

function open() {
  const socket = new WebSocket(url, ["foxglove.websocket.v1"]);
  socket.binaryType = "nodebuffer";
  let next = 0;
  socket.on("message", (data, isBinary) => {
    if (isBinary) {
      messages += 1;
      bytes += data.length;
      if (messages % 10 === 0) ages.push(Date.now() - Number(data.readBigUInt64LE(5)) / 1e6);
      return;
    }
    const message = JSON.parse(data);
    if (message.op !== "advertise") return;
    const wanted = message.channels.filter(({ topic }) => pattern.test(topic));
    const subscriptions = wanted.map(({ id }) => ({ id: next++, channelId: id }));
    socket.send(JSON.stringify({ op: "subscribe", subscriptions }));
  });
  socket.on("close", (code, reason) => closed.push(`${code} ${reason}`));
  socket.on("error", (error) => closed.push(String(error)));
  return socket;
}

const sockets = Array.from({ length: clients }, open);
await new Promise((resolve) => setTimeout(resolve, 2000)); // what is latched has come
messages = bytes = 0;
ages.length = 0;
await new Promise((resolve) => setTimeout(resolve, seconds * 1000));
ages.sort((a, b) => a - b);
const quantile = (q) => Number(ages[Math.floor(q * (ages.length - 1))]?.toFixed(2));
console.log(JSON.stringify({
  clients,
  messages_s: Math.round(messages / seconds),
  mb_s: Number((bytes / seconds / 1e6).toFixed(2)),
  age_ms: { p50: quantile(0.5), p95: quantile(0.95), p99: quantile(0.99) },
  closed,
}));
sockets.forEach((socket) => socket.terminate());
process.exit(0);
