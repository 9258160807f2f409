// SPDX-License-Identifier: Apache-2.0
// A stand-in for the station, for work on the page without DDS: the Foxglove protocol at /ws, the
// page in ./dist, answers under /api; a made-up flight.
import { readFileSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { WebSocketServer } from "ws";

import { flatIdl } from "./flat_idl.mjs";
import { diagnosticsOf, encode, freeFraming, samplesAt, schemaNameOf, typeOf,
} from "./synthetic.mjs";
import { pictureAt, videoAt } from "./synthetic_camera.mjs";

const kinds = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css",
  ".svg": "image/svg+xml", ".json": "application/json", ".txt": "text/plain" };
const policy = "default-src 'self'; script-src 'self'; style-src 'self' 'unsafe-inline'; " +
  "worker-src 'self'; connect-src 'self' ws: wss:; img-src 'self' data: blob:";

class StandIn {
  channels = new Map(); // topic → channel
  clients = new Map(); // socket → Map(channel id → subscription id)
  leases = new Map();
  last = new Map();
  orders = new Map();
  silent = new Set(); // vehicles of which nothing comes
  killed = new Set(); // services whose health does not come
  mismatched = new Set(); // topics whose quality of service does not match
  doubtful = new Set(); // vehicles whose perception sees several people
  unconfirmed = new Map(); // orders that the gate does not answer, by vehicle
  band_m = [1.5, 2.5]; // that the planners keep
  received = []; // orders, as they came
  bodies = []; // of orders that say more than their name
  chosen = new Map(); // what perception says of who is followed, by vehicle
  painted = 0; // pictures
  video = false; // is offered as well
  videoFault = false; // what comes of it cannot be decoded
  videoed = new Map(); // how many pictures of it were sent, by vehicle
  behind_s = 0; // by which samples are older than now, as those of a recording
  recording = null; // as the station's status has it
  clips = []; // requests
  map = new Map([["map.json", "null"]]); // files of the map, by path
  recordings = new Map(); // bytes by file name

  constructor({ port = 0, vehicles = 1, dist = "dist", blind = false,
    behind_s = 0, video = false } = {}) {
    this.behind_s = behind_s;
    this.video = video;
    this.dist = dist;
    this.names = Array.from({ length: vehicles }, (_, i) => `uav${i + 1}`);
    this.blind = new Set(blind ? this.names : []);
    this.http = createServer((request, response) => void this.answer(request, response));
    this.sockets = new WebSocketServer({ server: this.http, path: "/ws",
      handleProtocols: () => "foxglove.websocket.v1" });
    this.sockets.on("connection", (socket) => this.welcome(socket));
    this.http.listen(port, "127.0.0.1");
    this.begin_ms = Date.now();
    this.step = 0;
    for (const name of this.names)
      this.channel(`/${name}/mission/command`, typeOf("mission/command"));
    this.timer = setInterval(() => this.advance(), 10);
    this.reporter = setInterval(() => this.report(), 500);
  }

  get url() {
    return `http://127.0.0.1:${this.http.address().port}/`;
  }

  close() {
    clearInterval(this.timer);
    clearInterval(this.reporter);
    this.sockets.close();
    for (const socket of this.clients.keys()) socket.terminate();
    this.http.close();
  }

  channel(topic, type) {
    let channel = this.channels.get(topic);
    if (channel) return channel;
    channel = type === null
      ? { id: this.channels.size + 1, topic, encoding: "json", schemaName: "station", schema: "{}",
          schemaEncoding: "jsonschema" }
      : { id: this.channels.size + 1, topic, encoding: "cdr", schemaName: schemaNameOf(type),
          schema: flatIdl(type), schemaEncoding: "omgidl" };
    this.channels.set(topic, channel);
    for (const socket of this.clients.keys())
      socket.send(JSON.stringify({ op: "advertise", channels: [channel] }));
    return channel;
  }

  welcome(socket) {
    const subscriptions = new Map();
    this.clients.set(socket, subscriptions);
    socket.send(JSON.stringify({ op: "serverInfo", name: "stand-in", capabilities: [] }));
    socket.send(JSON.stringify({ op: "advertise", channels: [...this.channels.values()] }));
    socket.on("message", (data) => {
      const said = JSON.parse(data.toString());
      for (const s of said.subscriptions ?? []) subscriptions.set(s.channelId, s.id);
      for (const id of said.subscriptionIds ?? [])
        for (const [channel, of] of subscriptions) if (of === id) subscriptions.delete(channel);
    });
    socket.on("close", () => this.clients.delete(socket));
  }

  send(topic, type, bytes) {
    const channel = this.channel(topic, type);
    for (const [socket, subscriptions] of this.clients) {
      const id = subscriptions.get(channel.id);
      if (id === undefined) continue;
      const frame = Buffer.alloc(13 + bytes.byteLength);
      frame.writeUInt8(1, 0);
      frame.writeUInt32LE(id, 1);
      const behind_ms = type === null ? 0 : 1000 * this.behind_s;
      frame.writeBigUInt64LE(BigInt(Date.now() - behind_ms) * 1000000n, 5);
      frame.set(bytes, 13);
      socket.send(frame);
    }
  }

  advance() {
    const until = Math.floor((Date.now() - this.begin_ms) / 10);
    if (until - this.step > 50) this.step = until - 50;
    while (this.step < until) {
      this.step++;
      this.names.forEach((name, index) => {
        if (this.silent.has(name)) return;
        for (const [topic, message] of samplesAt(this.step / 100, this.step, index,
          this.orders.get(name), this.chosen.get(name)))
          if (!this.killed.has(message.service))
            this.send(`/${name}/${topic}`, typeOf(topic),
              encode(typeOf(topic), this.troubled(name, message)));
        if (this.step % 8 === 0 && !this.blind.has(name)) this.sendPicture(name, index);
        if (this.step % 8 === 4 && this.video) this.sendVideo(name, index);
      });
    }
  }

  isRead(topic, type) {
    const { id } = this.channel(topic, type);
    return [...this.clients.values()].some((subscribed) => subscribed.has(id));
  }

  // Painted only where somebody looks: that takes a while.
  sendPicture(name, index) {
    const topic = "camera/ground/image/compressed";
    if (!this.isRead(`/${name}/${topic}`, typeOf(topic))) return;
    this.painted++;
    this.sendAll(name, pictureAt(this.step / 100, index));
  }

  sendVideo(name, index) {
    const topic = "camera/ground/video";
    if (!this.isRead(`/${name}/${topic}`, typeOf(topic))) return this.videoed.delete(name);
    const number = this.videoed.get(name) ?? 0;
    this.videoed.set(name, number + 1);
    const samples = videoAt(this.step / 100, index, number);
    if (this.videoFault) samples[1][1].data.fill(0x55, 40);
    this.sendAll(name, samples);
  }

  sendAll(name, samples) {
    for (const [topic, message] of samples)
      this.send(`/${name}/${topic}`, typeOf(topic), encode(typeOf(topic), message));
  }

  troubled(name, message) {
    if (message.service !== "perception" || !this.doubtful.has(name)) return message;
    return { ...message, state: 1,
      last_error: "several people could be the one who is followed; see the image" };
  }

  status() {
    return {
      server: { version: "stand-in", uptime_s: (Date.now() - this.begin_ms) / 1000,
        clients: this.clients.size, control_enabled: true, needs_token: false },
      vehicles: this.names.map((name) => ({ name, seen_s_ago: 0,
        lease: this.leases.has(name) ? { operator: this.leases.get(name), expires_s: 30 } : null,
        last_command: this.last.get(name) ?? null,
        unconfirmed: this.unconfirmed.get(name) ?? null })),
      recording: this.recording, clients: [],
      topics: [...this.channels.values()].map((c) => ({ topic: c.topic, type: c.schemaName,
        vehicle: c.topic.split("/")[1], writers: 1, readers: 2, rate_hz: 25, bytes_s: 9000,
        age_s: 0.1, limited: false, qos_mismatch: this.mismatched.has(c.topic),
        foreign_type: null, resting: false })),
    };
  }

  report() {
    const type = typeOf("diagnostics");
    for (const name of this.names)
      this.send("/diagnostics", type, encode(type, diagnosticsOf(Date.now() / 1000, name,
        this.band_m)));
    this.send("/station/status", null, Buffer.from(JSON.stringify(this.status())));
  }

  async answer(request, response) {
    const path = new URL(request.url, "http://host").pathname;
    if (path.startsWith("/api/")) return this.api(path.slice(5), request, response);
    if (path.startsWith("/clips/")) return this.clip(request, response);
    if (path.startsWith("/recordings/")) return this.part(path.slice(12), request, response);
    if (this.map.has(path.slice(1))) return response.writeHead(200).end(this.map.get(path.slice(1)));
    const file = path === "/" ? "index.html" : path.slice(1);
    try {
      const body = readFileSync(join(this.dist, file));
      response.writeHead(200, { "Content-Type": kinds[extname(file)] ?? "application/octet-stream",
        "Content-Security-Policy": policy });
      response.end(body);
    } catch {
      response.writeHead(404).end();
    }
  }

  async api(path, request, response) {
    let text = "";
    for await (const part of request) text += part;
    const said = text ? JSON.parse(text) : {};
    const body = path === "status" ? this.status() : path === "recordings"
      ? [...this.recordings].map(([name, data]) => ({ file: name, bytes: data.length }))
      : path === "lease" ? this.lease(said) : path === "command" ? this.command(said)
        : { ok: false, reason: "not in the stand-in" };
    response.writeHead(200, { "Content-Type": "application/json" }).end(JSON.stringify(body));
    this.report();
  }

  part(name, request, response) {
    const bytes = this.recordings.get(decodeURIComponent(name));
    const range = /bytes=(\d+)-(\d+)/.exec(request.headers.range ?? "");
    if (!bytes || !range) return response.writeHead(404).end();
    const part = bytes.subarray(Number(range[1]), Number(range[2]) + 1);
    const last = Number(range[1]) + part.length - 1;
    response.writeHead(206, { "Content-Range": `bytes ${range[1]}-${last}/${bytes.length}` });
    response.end(part);
  }

  clip(request, response) {
    this.clips.push(request.url);
    response.writeHead(200, { "Content-Type": "video/webm" }).end("a film");
  }

  lease({ vehicle, operator, action, to }) {
    const holder = this.leases.get(vehicle);
    if (holder && holder !== operator) return { ok: false, reason: `${holder} has control` };
    if (action === "release") this.leases.delete(vehicle);
    else this.leases.set(vehicle, action === "hand_over" ? to : operator);
    return { ok: true, reason: "" };
  }

  command({ vehicle, command, operator, ...more }) {
    this.received.push(`${operator}: ${command} ${vehicle}`);
    if (Object.keys(more).length > 0) this.bodies.push(more);
    if (this.unconfirmed.has(vehicle))
      return { ok: false, reason: "the gate is silent", answered: false };
    const holder = this.leases.get(vehicle);
    const ok = command === "stop" || holder === operator;
    const id = (this.last.get(vehicle)?.id ?? 0) + 1;
    this.last.set(vehicle, { id, command, operator, result: ok ? "accepted" : "refused",
      reason: ok ? "" : "no lease" });
    if (ok && command === "stop")
      this.orders.set(vehicle, { mode: 3, reason: 9, phase: 5, command_id: BigInt(id),
        command_result: 1, operator_id: operator });
    if (ok && command === "start") this.orders.delete(vehicle);
    if (ok) this.obey(vehicle, command, more, BigInt(id), operator);
    return { ok, reason: ok ? "" : "no lease", answered: true };
  }

  obey(vehicle, command, more, command_id, operator_id) {
    const number = (value) => value ?? NaN;
    const order = (fields) => {
      const answer = { command_id, command_result: 1, operator_id, ...fields };
      this.orders.set(vehicle, { ...this.orders.get(vehicle), ...answer });
    };
    if (command === "follow") {
      this.chosen.set(vehicle, { state: more.person_id > 0 ? 1 : 0, person_id: more.person_id });
      order({ command: 10, chosen: true, person_id: more.person_id });
    }
    if (command === "framing")
      order({ command: 11, framing: { ...freeFraming, distance_m: number(more.distance_m),
        height_m: number(more.height_m), bearing_rad: number(more.bearing_rad),
        circling_radps: more.circling_radps } });
    if (command === "bounds")
      order({ command: 9, fence_m: more.fence_m.flat(), altitude_min_m: number(more.altitude_min_m),
        altitude_max_m: number(more.altitude_max_m) });
    if (command === "return_place")
      order({ command: 12, home_known: true, home_m: [...more.position_m, 0] });
  }
}

export function startStandIn(options) {
  return new Promise((resolve) => {
    const station = new StandIn(options);
    station.http.once("listening", () => resolve(station));
  });
}
