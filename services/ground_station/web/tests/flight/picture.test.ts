// SPDX-License-Identifier: Apache-2.0
// The picture on a real flight over DDS with rendered images; skipped without the pose networks or
// the models of people. FORETRACK_SHOTS=FOLDER keeps screenshots.
import assert from "node:assert/strict";
import { mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import { expectText, firstPicture_ms, launch, open } from "../chromium.mjs";
import { Flight } from "./program.ts";

const scenario = `
world:
  bounds_m: [-24, -12, 0, 24, 12, 5]
  boxes: [{min_m: [-10, 4, 0], max_m: [-7, 6, 3]}, {min_m: [0, -7, 0], max_m: [3, -4, 3]}]
target: {route_m: [[-16, 0], [14, 0], [14, 2], [-16, 2], [-16, 0]], speed_m_s: 0.8, person: man}
bystanders: [{person: girl, route_m: [[-12, 1.3], [16, 1.3]], speed_m_s: 0.7, start_s: 1.5}]
sensors: {color_images: true, landmark_rate_hz: 15, depth_images: true, depth_rate_hz: 5}
map: known
duration_s: 900
`;
const frame = ".camview .frame";
const shots = process.env["FORETRACK_SHOTS"];
const limits_ms = { first: 5000, lag: 800, order: 1500 };

const flight = new Flight();
let browser: Browser;
let page: Page & { problems: string[] };
let address = "";
let missing = ""; // why nothing can be seen

const median = (values: number[]): number =>
  [...values].sort((a, b) => a - b)[values.length >> 1] ?? NaN;

async function waitFor(pattern: RegExp, seconds: number): Promise<boolean> {
  for (let i = 0; i < 10 * seconds && !pattern.test(flight.output); i++)
    await new Promise((resolve) => setTimeout(resolve, 100));
  return pattern.test(flight.output);
}

before(async () => {
  const file = join(flight.folder, "street.yaml");
  writeFileSync(file, scenario);
  flight.service("uav1", "stages", "--no-mapping");
  flight.service("uav1", "safety_gate");
  const simulator = flight.start("simulator", "simulator", "--vehicle", "uav1", "--use-sim-time",
    "--scenario", file, "--map", "known", "--endless");
  address = await flight.station("--enable-control", "--print-token");
  if (simulator.exitCode !== null || await waitFor(/\.\/run models|person.*model|no such archive/, 3))
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

/** Until the first picture of pages that are opened one after another, ms. */
async function firsts(count: number): Promise<number[]> {
  const values: number[] = [];
  for (let i = 0; i < count; i++) {
    const opened = await open(browser, address, { name: "bob" });
    values.push(await firstPicture_ms(opened));
    await opened.context().close();
  }
  return values;
}

async function lags(count: number): Promise<number[]> {
  const values: number[] = [];
  let last = "";
  const end = Date.now() + 60000;
  while (values.length < count && Date.now() < end) {
    const [pictures, lag] = await page.evaluate((selector) => {
      const { pictures = "", lag = "" } = document.querySelector<HTMLElement>(selector)!.dataset;
      return [pictures, lag];
    }, frame) as [string, string];
    if (pictures !== last && lag !== "") values.push(Number(lag));
    last = pictures;
    await page.waitForTimeout(20);
  }
  return values;
}

test("pictures come, soon after the page is opened and soon after they were taken", async (t) => {
  if (missing) return t.skip(missing);
  await page.waitForSelector(`${frame}[data-pictures]`);
  await page.waitForTimeout(5000);
  const first = await firsts(3);
  await page.evaluate("foretrack.watching = false");
  const alone: number[] = [];
  for (let i = 0; i < 3; i++) {
    await page.waitForTimeout(4000); // nobody reads pictures any more, and none is encoded
    alone.push(...await firsts(1));
  }
  await page.evaluate("foretrack.watching = true");
  const ages = await lags(100);
  const p95 = [...ages].sort((a, b) => a - b)[Math.floor(0.95 * ages.length)];
  console.log(`first picture after ${first.join(", ")} ms, where nobody else watched after ` +
    `${alone.join(", ")} ms; from the image's stamp until it is drawn: ` +
    `median ${median(ages)} ms, P95 ${p95} ms, of ${ages.length}`);
  assert.ok(median([...first, ...alone]) <= limits_ms.first, `${first} ms, ${alone} ms`);
  assert.ok(median(ages) <= limits_ms.lag, `${median(ages)} ms`);
  assert.deepEqual(page.problems, []);
});

test("the followed person has a box where they are, and everybody else a number", async (t) => {
  if (missing) return t.skip(missing);
  await page.getByRole("button", { name: "picture large" }).click();
  await page.waitForSelector('.people [aria-pressed="true"]');
  await expectText(page, '.people [aria-pressed="true"]', /◉ \d+ · [123]\.\d m/);
  const listed = () => page.evaluate(() => {
    const { latest } = (window as never as { foretrack: any }).foretrack.vehicle;
    const { x, y } = latest["odometry"].message.pose.pose.position;
    const { id, position_m } = latest["bodies"].message.bodies.find((b: any) => b.followed);
    const [, told, far] = /(\d+) · ([\d.]+) m/.exec(
      document.querySelector('.people [aria-pressed="true"]')!.textContent!)!.map(Number);
    return { id, told, far, away: Math.hypot(position_m[0] - x, position_m[1] - y) };
  });
  const { id, told, far, away } = await listed();
  assert.equal(told, id);
  assert.ok(Math.abs(far! - away) < 0.3, `${far} m, ${away} m by the topics`); // both walk and fly on
  if (shots) {
    mkdirSync(shots, { recursive: true });
    await page.screenshot({ path: join(shots, "picture.png") });
  }
});

test("an order to follow is taken by the gate within half a second", async (t) => {
  if (missing) return t.skip(missing);
  await page.getByRole("button", { name: "Take control" }).click();
  await page.waitForSelector('.people [aria-pressed="true"]:not([disabled])');
  const id = await page.locator('.people [aria-pressed="true"]').textContent();
  const took_ms = await page.evaluate(async (person_id) => {
    const session = (window as never as { foretrack: any }).foretrack;
    const begin = performance.now();
    await session.operator.command("uav1", "follow", { person_id });
    for (;;) {
      const gate = session.vehicle.latest["safety/state"].message;
      if (gate.chosen && gate.person_id === person_id) // its last order may be a lease's again
        return performance.now() - begin;
      if (performance.now() - begin > 10000) return NaN;
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
  }, Number(/\d+/.exec(id ?? "")?.[0]));
  console.log(`from the tap until the gate says so: ${took_ms.toFixed(0)} ms`);
  assert.ok(took_ms <= limits_ms.order, `${took_ms} ms`);
});

test("a framing is taken, and one that is not safe is refused with what to do", async (t) => {
  if (missing) return t.skip(missing);
  await page.getByRole("tab", { name: "Fly" }).click();
  await page.locator(".framing button:not([disabled])", { hasText: "Close behind" }).click();
  await expectText(page, '[data-field="framing"]', /set: 2\.0 m, 0\.3 m above the torso, behind/);
  const said = await page.evaluate(async () => {
    const { operator } = (window as never as { foretrack: any }).foretrack;
    return operator.command("uav1", "framing", { distance_m: 0.2, height_m: null,
      bearing_rad: null, circling_radps: 0 });
  }) as { ok: boolean; reason: string };
  assert.equal(said.ok, false);
  assert.match(said.reason, /refused: this framing is out of its safe ranges/);
});

test("the station stays small", async (t) => {
  if (missing) return t.skip(missing);
  const { pid } = flight.processes.get("station")!;
  const rss = /VmRSS:\s+(\d+) kB/.exec(readFileSync(`/proc/${pid}/status`, "utf8"))?.[1];
  console.log(`the station's memory: ${Math.round(Number(rss) / 1000)} MB`);
  assert.ok(Number(rss) < 200000);
});
