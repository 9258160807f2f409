// SPDX-License-Identifier: Apache-2.0
// On a real flight over DDS with rendered images somebody of the same model and clothes crosses between the vehicle
// and the followed person, and walks along beside them. Nobody can say from the images who of them it was before: the
// page asks who it is, shows both, and the operator's answer is obeyed. Skipped without the pose networks or the
// models of people. FORETRACK_SHOTS=FOLDER keeps a screenshot.
import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import { launch, open } from "../chromium.mjs";
import { Flight } from "../flight/program.ts";

// They are in line with the vehicle some 19 s after the start.
const scenario = `
world:
  bounds_m: [-26, -12, 0, 30, 12, 5]
  boxes: [{min_m: [-24, 8, 0], max_m: [-20, 11, 3]}]
target: {route_m: [[-22, 0], [28, 0]], speed_m_s: 0.5, person: man}
bystanders: [{person: man, route_m: [[-16, -4], [-13.2, -1.5], [-11.8, 1.2], [-10.5, 2.0], [26, 2.0]], speed_m_s: 0.5, start_s: 9.5}]
sensors: {color_images: true, landmark_rate_hz: 10, depth_images: true, depth_rate_hz: 5}
map: known
duration_s: 900
`;
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
