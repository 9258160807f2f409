// SPDX-License-Identifier: Apache-2.0
// The page in a browser, against a stand-in for the station whose every value is known.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import { expectText, launch, open } from "../chromium.mjs";
import { type StandIn, startStandIn } from "../stand_in.mjs";
import { probabilities } from "../synthetic.mjs";
import { syntheticRecording } from "../write_mcap.mjs";

let browser: Browser;
let station: StandIn;
let page: Page & { problems: string[] };

before(async () => {
  browser = await launch();
});
after(() => browser.close());
beforeEach(async () => {
  station = await startStandIn({ vehicles: 2, blind: true }); // pictures: picture.test.ts
  page = await open(browser, station.url, { name: "ada" });
  await page.waitForSelector('[data-vehicle="uav2"]');
});
afterEach(async () => {
  await page.context().close();
  station.close();
});

const card = (name: string, field: string): string =>
  `[data-vehicle="${name}"] [data-field="${field}"]`;
const tab = (name: string) => page.getByRole("tab", { name }).click();

test("each vehicle has a card, and the chosen one is described", async () => {
  await expectText(page, card("uav1", "mode"), /^track$/);
  await expectText(page, card("uav1", "health"), /5 services well/);
  await expectText(page, card("uav1", "losses"), /^15$/);
  await expectText(page, card("uav1", "battery"), /(7[0-2]|6\d) % 15\.4 V/);
  await expectText(page, card("uav1", "rates"), /\d\d · \d\d · \d\d Hz/);
  await page.click('[data-vehicle="uav2"]');
  assert.equal(await page.getAttribute('[data-vehicle="uav2"]', "aria-pressed"), "true");
  await expectText(page, '[data-field="distance"]', /^(1\.[67-9]\d|2\.[0-3]\d) m$/);
  await expectText(page, '[data-field="p-right"]', /right 0\.05/);
  await page.keyboard.press("[");
  assert.equal(await page.getAttribute('[data-vehicle="uav1"]', "aria-pressed"), "true");
  assert.deepEqual(page.problems, []);
});

test("the scene is drawn beside the page, and turned by the mouse", async () => {
  const drawing = await launch({ scene: true });
  const seen = await open(drawing, station.url);
  await seen.waitForSelector("[data-first]");
  await seen.getByRole("button", { name: "Orbit" }).click(); // it stays, where nobody turns it
  await expectText(seen, ".scene .label", /uav1/);
  const end = Date.now() + 20000;
  const settled = () =>
    seen.workers()[0]!.evaluate("self.view.kind === 'orbit' && self.view.placed");
  while (!(await settled())) assert.ok(Date.now() < end);
  const yaw = () => seen.workers()[0]!.evaluate("self.view.controls.getAzimuthalAngle()");
  const before = Number(await yaw());
  const box = (await seen.locator(".scene canvas").boundingBox())!;
  await seen.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await seen.mouse.down();
  await seen.mouse.move(box.x + box.width / 2 + 100, box.y + box.height / 2, { steps: 5 });
  await seen.mouse.up();
  const turned = (2 * Math.PI * 100) / box.height; // as OrbitControls has it
  while (Math.abs(Math.sin((Number(await yaw()) - before + turned) / 2)) > 0.01) {
    assert.ok(Date.now() < end, `${before} → ${await yaw()}, ${turned} expected`);
    await seen.waitForTimeout(100);
  }
  await seen.locator(".scene .label.body").first().dispatchEvent("click");
  await expectText(seen, ".scene .tapmenu", /person [12] · \d\.\d m/);
  assert.deepEqual(seen.problems, []);
  await drawing.close();
});

test("the plots tell the newest values", async () => {
  await expectText(page, '[data-chart="Image to setpoint"] .values', /80 ms/);
  await expectText(page, '[data-chart="Plan time"] .values', /predict 2\.5 ms.*path 1\.5 ms/);
  await expectText(page, '[data-chart="Speed"] .values', /vehicle 1\.00 m\/s\s*person 1\.00 m\/s/);
  await expectText(page, '[data-chart="States"] .values',
    /gate track · plan fresh · person tracking/);
});

test("the band of distances is the one that the planner says", async () => {
  const colored = (band: string) =>
    expectText(page, `[data-field="distance"]${band}`, /^(1\.[67-9]\d|2\.[0-3]\d) m$/);
  await colored(":not(.off)");
  station.band_m = [5, 6];
  await colored(".off");
});

test("the cursor is shared by all plots", async () => {
  const over = page.locator(".u-over");
  await over.nth(0).hover({ position: { x: 300, y: 20 } });
  const lefts = await page.locator(".u-cursor-x").evaluateAll((lines) =>
    lines.map((line) => (line as HTMLElement).style.transform));
  assert.equal(lefts.length, 7);
  assert.equal(new Set(lefts).size, 1);
});

test("a vehicle that falls silent dims, says how old it is, and raises one alarm", async () => {
  station.silent.add("uav2");
  await expectText(page, card("uav2", "link"), /^[3-9]\.\d s$/);
  await expectText(page, '[data-vehicle="uav2"] .stale .age', /s old/);
  await expectText(page, '[data-alarm="uav2 silent"]', /nothing heard for \d+ s/);
  await expectText(page, card("uav1", "link"), /^0\.\d s$/);
  station.silent.clear();
  await expectText(page, '[data-alarm="uav2 silent"]', /over at/);
  await page.keyboard.press("a");
  await page.waitForSelector('[data-alarm="uav2 silent"]', { state: "detached" });
});

test("a killed service is named, with its age", async () => {
  await expectText(page, card("uav1", "health"), /5 services well/);
  station.killed.add("planning");
  await expectText(page, card("uav1", "health"), /planning silent/);
  await expectText(page, '[data-alarm="uav1 service silent planning"]', /planning: silent for/);
  await tab("Diagnostics");
  await expectText(page, '[data-service="planning"]', /silent/);
  await expectText(page, '[data-service="mapping"]', /running/);
});

test("doubt about who is followed is an alarm, and so is an order that is not confirmed", async () => {
  await expectText(page, card("uav1", "health"), /5 services well/);
  station.doubtful.add("uav1");
  station.unconfirmed.set("uav2", { command: "stop", operator: "ada", still_sent: true });
  await expectText(page, card("uav1", "health"), /several people: which one\?/);
  await expectText(page, '[data-alarm="uav1 person perception"].alarm',
    /■.*several people could be the one who is followed/);
  await expectText(page, card("uav2", "order"), /stop not confirmed/);
  await expectText(page, '[data-alarm="uav2 order"].alarm',
    /stop of ada: not confirmed by the safety gate, still being sent/);
  await page.click('[data-vehicle="uav2"]');
  await page.keyboard.down("s");
  await expectText(page, '[data-field="answer"]', /stop uav2: NOT CONFIRMED: the gate is silent/);
  await page.keyboard.up("s");
  station.doubtful.clear();
  station.unconfirmed.clear();
  await expectText(page, card("uav1", "health"), /5 services well/);
  await expectText(page, '[data-alarm="uav2 order"]', /over at/);
  assert.equal(await page.locator(card("uav2", "order")).count(), 0);
});

test("topics show their mismatches first", async () => {
  station.mismatched.add("/uav2/odometry");
  await tab("Topics");
  await expectText(page, "[data-topic]", /^uav2\/odometry.*QoS mismatch/);
  await expectText(page, '[data-topic="uav1/target/state"]', /TargetState.*25\.0 Hz/);
});

test("STOP is sent when it was held, not when it was touched, and without a lease", async () => {
  const stop = page.locator("button.stop");
  await stop.click();
  await page.waitForTimeout(800);
  assert.deepEqual(station.received, []);
  await stop.dispatchEvent("pointerdown", { button: 0 });
  await expectText(page, card("uav1", "mode"), /brake/);
  await expectText(page, card("uav1", "phase"), /stopped/);
  assert.deepEqual(station.received, ["ada: stop uav1"]);
  await page.click('[data-vehicle="uav2"]');
  await page.keyboard.down("s");
  await expectText(page, card("uav2", "phase"), /stopped/);
  await page.keyboard.up("s");
  assert.deepEqual(station.received.slice(1), ["ada: stop uav2"]);
});

test("one operator has control, others see who, and it can be handed over", async () => {
  const other = await open(browser, station.url, { name: "bob" });
  const hold = (of: Page) => of.getByRole("button", { name: "Hold", exact: true });
  await expectText(page, '[data-field="answer"]', /take control first/);
  await page.getByRole("button", { name: "Take control" }).click();
  await expectText(other, card("uav1", "lease"), /ada/);
  await expectText(other, '[data-field="answer"]', /ada has control/);
  assert.ok(await hold(other).isDisabled());
  await hold(page).click();
  await expectText(page, '[data-field="answer"]', /hold uav1: sent/);
  await tab("Control");
  await page.fill('[aria-label="hand over uav1 to"]', "bob");
  await page.getByRole("button", { name: "Hand over" }).click();
  await expectText(page, card("uav1", "lease"), /bob/);
  await hold(other).click();
  await expectText(other, '[data-field="answer"]', /hold uav1: sent/);
  assert.deepEqual(station.received, ["ada: hold uav1", "bob: hold uav1"]);
  await other.context().close();
});

test("without the station all is old, and it comes back by itself", async () => {
  const { port } = new URL(station.url);
  station.close();
  await expectText(page, '[data-field="station"]', /no station/);
  await expectText(page, '[data-field="gate"] ~ *, .readout .stale .age', /s old/);
  station = await startStandIn({ vehicles: 2, port: Number(port) });
  await expectText(page, '[data-field="station"]', /live/);
  await expectText(page, card("uav1", "link"), /^0\.\d s$/);
});

test("a recording is replayed, stepped, sought and marked by its log time", async () => {
  const begin_s = 1_700_000_000;
  const bytes = await syntheticRecording({ begin_s, seconds: 8 });
  await tab("Recordings");
  await page.setInputFiles('[aria-label="open a recording"]',
    { name: "flight.mcap", mimeType: "application/octet-stream", buffer: Buffer.from(bytes) });
  await page.getByRole("button", { name: "pause" }).click();
  await page.fill('[aria-label="go to"]', "4.38"); // the recording begins 0.02 s into the flight
  await page.keyboard.press("Enter");
  await expectText(page, '[data-field="replay-time"]', /^0:04\.4 \/ 0:08\.0$/);
  const expected = probabilities(4.4);
  await expectText(page, '[data-field="p-forward"]', new RegExp(expected["forward"]!.toFixed(2)));
  await expectText(page, '[data-field="p-left"]', new RegExp(expected["left"]!.toFixed(2)));
  await page.locator("body").press("b");
  await page.locator("body").press(".");
  await expectText(page, '[data-field="replay-time"]', /^0:04\.5/);
  await page.locator("body").press("ArrowLeft");
  await expectText(page, '[data-field="replay-time"]', /^0:03\.5/);
  await page.click(".bookmark button");
  await expectText(page, '[data-field="replay-time"]', /^0:04\.4/);
  await page.selectOption('[aria-label="speed"]', "10");
  await page.getByRole("button", { name: "play", exact: true }).click();
  await expectText(page, '[data-field="replay-time"]', /^0:08\.0/);
  await page.getByRole("button", { name: "End replay" }).click();
  await page.waitForSelector('[data-vehicle="uav2"]');
  assert.deepEqual(page.problems, []);
});

test("a recording of the station is read in parts", async () => {
  const bytes = await syntheticRecording({ begin_s: 1_700_000_000, seconds: 20 });
  assert.ok(bytes.length > 3 << 20, "the file is to be larger than some parts");
  station.recordings.set("day 1.mcap", bytes);
  await tab("Recordings");
  await page.getByRole("button", { name: "Replay" }).click();
  await page.getByRole("button", { name: "pause" }).click();
  await page.fill('[aria-label="go to"]', "18.98");
  await page.keyboard.press("Enter");
  await expectText(page, '[data-field="replay-time"]', /^0:19\.0 \/ 0:20\.0$/);
  const expected = probabilities(19)["left"]!;
  await expectText(page, '[data-field="p-left"]', new RegExp(expected.toFixed(2)));
  await expectText(page, '[data-field="person"]', /tracking/);
  assert.equal(await page.locator(".readout .stale").count(), 0);
});

test("a recording that the station serves is no older than it is played", async () => {
  const serving = await startStandIn({ vehicles: 1, behind_s: 300 });
  try {
    const seen = await open(browser, serving.url);
    await seen.waitForSelector('[data-vehicle="uav1"]');
    await expectText(seen, card("uav1", "link"), /^0\.\d s$/);
    await expectText(seen, card("uav1", "health"), /5 services well/);
    await expectText(seen, '[data-field="picture-age"]', /^\d+ ms$/);
    assert.equal(await seen.locator("[data-alarm]").count(), 0);
    await seen.context().close();
  } finally {
    serving.close();
  }
});

test("what is not a recording is refused with a reason", async () => {
  await tab("Recordings");
  await page.setInputFiles('[aria-label="open a recording"]',
    { name: "notes.txt", mimeType: "text/plain", buffer: Buffer.from("not a recording") });
  await expectText(page, ".recordings output", /notes\.txt cannot be replayed/);
});

test("on a phone nothing is cut off, and STOP is on every tab", async () => {
  const phone = await open(browser, station.url, { width: 390, height: 844 });
  await phone.waitForSelector('[data-vehicle="uav2"]');
  const tabs = ["Scene", "Plots", "Events", "Diagnostics", "Topics", "Recordings", "Control"];
  for (const name of tabs) {
    await phone.getByRole("tab", { name }).click();
    const box = (await phone.locator("button.stop").first().boundingBox())!;
    assert.ok(box.y + box.height <= 844 && box.x + box.width <= 390, name);
    const wide = await phone.evaluate(() => document.documentElement.scrollWidth);
    assert.ok(wide <= 390, `${name}: ${wide} px wide`);
    const aside = await phone.locator(".table").evaluateAll((tables) =>
      tables.map((table) => table.scrollWidth - table.clientWidth));
    assert.ok(aside.every((px) => px <= 0), `${name}: its table scrolls sideways`);
  }
  await phone.context().close();
});
