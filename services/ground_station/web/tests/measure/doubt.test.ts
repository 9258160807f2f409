// SPDX-License-Identifier: Apache-2.0
// Two people of the same model and clothes meet on a real flight over DDS with rendered images, while
// perception stands still for some seconds. Then the page asks who it is, shows both, and the operator's
// answer is obeyed. Skipped without the pose networks or the models of people. FORETRACK_SHOTS=FOLDER
// keeps a screenshot.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import { launch, open } from "../chromium.mjs";
import { Flight } from "../flight/program.ts";

// The other one crosses the followed one's way 12 s after the start, and walks along beside them.
const scenario = `
world:
  bounds_m: [-24, -12, 0, 30, 12, 5]
  boxes: [{min_m: [-24, 8, 0], max_m: [-20, 11, 3]}]
target: {route_m: [[-16, 0], [28, 0]], speed_m_s: 0.6, person: man}
bystanders: [{person: man, route_m: [[-12.5, 1.5], [-10, 0.3], [-6.5, -1.6], [26, -1.6]], speed_m_s: 0.6, start_s: 6.3}]
sensors: {color_images: true, landmark_rate_hz: 10, depth_images: true, depth_rate_hz: 5}
map: known
duration_s: 900
`;
const blind_s = [11.5, 18] as const; // of the flight
const shots = process.env["FORETRACK_SHOTS"];
const patience_ms = 90000;

const flight = new Flight();
let browser: Browser;
let page: Page & { problems: string[] };
let missing = "";

async function said(pattern: RegExp, seconds: number): Promise<boolean> {
  for (let i = 0; i < 10 * seconds && !pattern.test(flight.output); i++)
    await new Promise((resolve) => setTimeout(resolve, 100));
  return pattern.test(flight.output);
}

/** By the flight's own clock. */
const flightIsAt = (time_s: number) => page.waitForFunction((at_s) => {
  const { vehicle } = (window as never as { foretrack: any }).foretrack;
  const { stamp } = vehicle?.latest["odometry"]?.message.header ?? { stamp: { sec: -1 } };
  return stamp.sec + 1e-9 * (stamp.nanosec ?? stamp.nsec) >= at_s;
}, time_s, { polling: 50, timeout: patience_ms });

before(async () => {
  const file = join(flight.folder, "twins.yaml");
  writeFileSync(file, scenario);
  flight.service("uav1", "stages", "--no-mapping");
  flight.service("uav1", "safety_gate");
  const simulator = flight.start("simulator", "simulator", "--vehicle", "uav1", "--use-sim-time",
    "--scenario", file, "--map", "known", "--endless");
  const address = await flight.station("--enable-control", "--print-token");
  if (simulator.exitCode !== null || await said(/\.\/run models|person.*model|no such archive/, 3))
    missing = "there are no rendered people, or no pose networks";
  if (missing) return;
  flight.order("uav1", "start");
  browser = await launch();
  page = await open(browser, address, { name: "ada" });
});
after(async () => {
  await browser?.close();
  await flight.end();
});

test("of two who look the same the page asks who it is, and the answer is obeyed", async (t) => {
  if (missing) return t.skip(missing);
  await page.locator("button.lease:not([disabled])").first().click();
  await flightIsAt(blind_s[0]);
  flight.signal("SIGSTOP", "uav1 stages");
  await flightIsAt(blind_s[1]);
  flight.signal("SIGCONT", "uav1 stages");
  await page.waitForSelector(".choice", { timeout: patience_ms });
  const answers = page.locator(".choice figure:not(.before)");
  await page.waitForFunction(() =>
    document.querySelectorAll(".choice figure:not(.before) img").length >= 2 &&
    document.querySelector(".choice figure.before img") !== null);
  if (shots) {
    mkdirSync(shots, { recursive: true });
    await page.screenshot({ path: join(shots, "doubt.png") });
  }
  const last = answers.last();
  const id = Number(/\d+/.exec((await last.locator("figcaption").textContent())!)![0]);
  await last.locator("button:not([disabled])").click();
  await page.waitForSelector(".choice", { state: "detached" });
  await page.waitForFunction((person_id) => {
    const { latest } = (window as never as { foretrack: any }).foretrack.vehicle;
    const choice = latest["target/choice"].message;
    const followed = latest["bodies"].message.bodies.find((b: any) => b.followed);
    return choice.state === 1 && choice.person_id === person_id && followed?.id === person_id;
  }, id);
  assert.deepEqual(page.problems, []);
});
