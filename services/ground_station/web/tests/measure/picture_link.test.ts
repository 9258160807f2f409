// SPDX-License-Identifier: Apache-2.0
// How old a picture is on the page over a link of 20 % loss and 50 ms each way, from when the station has
// it until it is drawn, and at the same time on this machine. A flight with rendered images is recorded, and
// replayed for the measurement, so that the machine has time for it. As root, with TUN devices: else skipped.
// BYTES_S of the link: 2e6.
import assert from "node:assert/strict";
import { type ChildProcess, spawn, spawnSync } from "node:child_process";
import { existsSync, readdirSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";

import { Flight } from "../flight/program.ts";

const [here, there] = ["198.18.78.1", "198.18.78.2"]; // of the range for measurements
const scenario = `
world: {bounds_m: [-24, -12, 0, 24, 12, 5], boxes: [{min_m: [0, -7, 0], max_m: [3, -4, 3]}]}
target: {route_m: [[-16, 0], [14, 0], [14, 2], [-16, 2], [-16, 0]], speed_m_s: 0.8, person: man}
sensors: {color_images: true, landmark_rate_hz: 15, depth_images: true, depth_rate_hz: 5}
map: known
duration_s: 900
`;
const flight = new Flight();
let link: ChildProcess | null = null;
let missing = process.getuid?.() === 0 && existsSync("/dev/net/tun") ? "" : "no root, or no /dev/net/tun";
let [near, far] = ["", ""];

const after_ms = (ms: number) => new Promise((done) => setTimeout(done, ms));

async function recordFlight(): Promise<void> {
  const file = join(flight.folder, "street.yaml");
  writeFileSync(file, scenario);
  flight.service("uav1", "stages", "--no-mapping");
  flight.service("uav1", "safety_gate");
  flight.start("simulator", "simulator", "--vehicle", "uav1", "--use-sim-time", "--scenario", file,
    "--map", "known", "--endless");
  flight.order("uav1", "start");
  await after_ms(5000);
  const recorder = flight.start("record", "record", "--recordings", "flight", "--for", "40");
  await new Promise((done) => recorder.once("exit", done));
  await flight.end();
}

before(async () => {
  if (missing) return;
  const script = resolve("../../../tests/system/lossy_link.py");
  link = spawn("nice", ["-n", "-15", "python3", script, "foretrack-pic", here, there, "0.2", "0.05",
    process.env["BYTES_S"] ?? "2e6"], { stdio: "inherit" });
  await recordFlight();
  const port = 20000 + Math.floor(10000 * Math.random());
  const recording = readdirSync(join(flight.folder, "flight"))[0]!;
  flight.start("station", "replay", join("flight", recording), "--again", "--port", `${port}`, "--address", "0.0.0.0", "--insecure-lan",
    "--allow-host", `${there}:${port}`, "--print-token", "--token-file", "tokens");
  for (let i = 0; i < 300 && !/#token=/.test(flight.output); i++) await after_ms(100);
  const token = /#(token=\S+)/.exec(flight.output)?.[1];
  if (!token) throw new Error(`the station prints no address:\n${flight.output}`);
  [near, far] = [`http://127.0.0.1:${port}/#${token}`, `http://${there}:${port}/#${token}`];
});
after(async () => {
  await flight.end();
  link?.kill();
});

test("over 20 % loss and 50 ms each way a picture is drawn within 600 ms of its image, at the median", (t) => {
  if (missing) return t.skip(missing);
  const probe = spawnSync(process.execPath, ["probe/picture_age.mjs", near, far, "30"],
    { encoding: "utf8", stdio: ["ignore", "pipe", "inherit"], timeout: 240000 });
  console.log(probe.stdout.trim());
  const { far: over } = JSON.parse(probe.stdout) as { far: { p50_ms: number } };
  assert.ok(over.p50_ms <= 600, probe.stdout);
});
