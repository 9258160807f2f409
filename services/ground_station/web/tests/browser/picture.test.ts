// SPDX-License-Identifier: Apache-2.0
// The picture, who is chosen in it, and what is set on the page, against a stand-in.
import assert from "node:assert/strict";
import { after, afterEach, before, beforeEach, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import { expectText, firstPicture_ms, launch, open } from "../chromium.mjs";
import { type StandIn, startStandIn } from "../stand_in.mjs";
import { origin } from "../synthetic.mjs";
import { png } from "../synthetic_camera.mjs";
import { syntheticRecording } from "../write_mcap.mjs";

let browser: Browser;
let station: StandIn;
let page: Page & { problems: string[] };

before(async () => {
  browser = await launch();
});
after(() => browser.close());
beforeEach(async () => {
  station = await startStandIn({ vehicles: 2 });
  page = await open(browser, station.url, { name: "ada" });
});
afterEach(async () => {
  await page.context().close();
  station.close();
});

const frame = ".camview .frame";
const take = () => page.getByRole("button", { name: "Take control" }).click();
const tab = (name: string) => page.getByRole("tab", { name }).click();
const pictures = async () => Number(await page.getAttribute(frame, "data-pictures") ?? 0);

/** In the list below the picture. */
const tapPerson = (id: number) =>
  page.locator(".people button", { hasText: new RegExp(`^. ${id} `) }).click();

test("pictures are drawn as they come, with their age", async () => {
  await page.waitForSelector(`${frame}[data-pictures]`);
  const first_ms = await firstPicture_ms(page);
  assert.ok(first_ms < 3000, `the first picture after ${first_ms} ms`);
  const before = await pictures();
  await page.waitForTimeout(1000);
  assert.ok(await pictures() > before + 5);
  await expectText(page, '[data-field="picture-age"]', /^\d+ ms$/);
  assert.ok(Number(await page.getAttribute(frame, "data-lag")) < 500);
  assert.deepEqual(page.problems, []);
});

test("the first picture is drawn while the page is still being read", async () => {
  const second = await page.context().newPage();
  let goOn: () => void = () => {};
  const read = new Promise<void>((resolve) => (goOn = resolve));
  await second.route("**/main.js", async (route) => {
    await read;
    await route.continue();
  });
  await second.goto(station.url, { waitUntil: "commit" });
  await second.waitForSelector(".loading canvas");
  assert.match(await second.locator(".loading figcaption").innerText(), /^\d\d:\d\d:\d\d UTC$/);
  const first_ms = await firstPicture_ms(second);
  goOn();
  await second.waitForSelector(`${frame}[data-pictures]`);
  assert.equal(await second.locator(".loading").count(), 0);
  assert.equal(await firstPicture_ms(second), first_ms);
});

test("nothing is read while nobody looks, and it goes on when somebody does", async () => {
  await page.waitForSelector(`${frame}[data-pictures]`);
  await page.getByRole("button", { name: "hide the picture" }).click();
  await page.waitForTimeout(300);
  const painted = station.painted;
  await page.waitForTimeout(600);
  assert.equal(station.painted, painted);
  await page.getByRole("button", { name: "Picture", exact: true }).click();
  await page.waitForSelector(`${frame}[data-pictures]`);
});

test("a picture that grows old is marked, and says how old it is", async () => {
  await page.waitForSelector(`${frame}[data-pictures]`);
  station.blind.add("uav1");
  await expectText(page, '[data-field="picture-age"]', /▲ ([2-9]|\d\d)\.\d s old/);
  assert.equal(await page.locator(".camview.old").count(), 1);
  station.blind.clear();
  await expectText(page, '[data-field="picture-age"]', /^\d+ ms$/);
});

test("a vehicle without a camera says why there is no picture", async () => {
  await page.context().close();
  station.close();
  station = await startStandIn({ vehicles: 1, blind: true });
  page = await open(browser, station.url, { name: "ada" });
  await expectText(page, ".camview .why", /No colour images come from the vehicle/);
});

test("a box that is tapped offers to follow that person, under the lease", async () => {
  await page.waitForSelector(`${frame}[data-pictures]`);
  await page.getByRole("button", { name: "picture large" }).click();
  await page.waitForSelector(".people button");
  const box = (await page.locator(frame).boundingBox())!;
  // The followed person is near the middle, under the horizon.
  await page.mouse.click(box.x + box.width / 2, box.y + 0.6 * box.height);
  await expectText(page, ".tapmenu", /person 1 · [12]\.\d m.*take control first/);
  assert.ok(await page.locator(".tapmenu .follow").isDisabled());
  await take();
  await page.locator(".tapmenu .follow:not([disabled])").click();
  await expectText(page, '[data-field="choice"]', /nobody is followed yet: tap a person/);
  assert.deepEqual(station.bodies, [{ person_id: 0 }]);
  await page.waitForSelector(".people button:not([disabled])");
  await tapPerson(1);
  await expectText(page, '[data-field="choice"]', /following person 1, 93 % sure/);
  assert.deepEqual(station.bodies[1], { person_id: 1 });
});

test("where it is in doubt, both are shown, and the operator says who it is", async () => {
  station.chosen.set("uav1", { state: 2, person_id: 1 });
  await expectText(page, ".choice", /Who is it\?.*goes on in 8 s/);
  assert.equal(await page.locator(".choice img").count(), 3);
  const answer = page.locator(".choice figure:nth-of-type(3) button");
  assert.ok(await answer.isDisabled());
  await take();
  await page.locator(".choice figure:nth-of-type(3) button:not([disabled])").click();
  await page.waitForSelector(".choice", { state: "detached" });
  assert.deepEqual(station.bodies, [{ person_id: 2 }]);
  await expectText(page, '[data-field="choice"]', /following person 2/);
});

test("framing is set by sliders and presets, and what is set is shown", async () => {
  await tab("Fly");
  await expectText(page, '[data-field="framing"]', /as the parameters say/);
  await expectText(page, ".framing .why", /take control first/);
  assert.ok(await page.getByRole("button", { name: "Close behind" }).isDisabled());
  await take();
  await page.locator(".framing button:not([disabled])", { hasText: "Close behind" }).click();
  await expectText(page, '[data-field="framing"]', /set: 2\.0 m, 0\.3 m above the torso, behind$/);
  await page.getByRole("slider", { name: "distance" }).fill("4.5");
  await expectText(page, '[data-field="framing"]', /set: 4\.5 m, 0\.3 m above the torso, behind$/);
  await page.getByRole("radio", { name: "left" }).click();
  await expectText(page, '[data-field="framing"]', /set: 4\.5 m, 0\.3 m above the torso, left$/);
  assert.deepEqual(station.bodies.map((b) => b["distance_m"]), [2, 4.5, 4.5]);
  assert.equal(station.bodies[2]!["bearing_rad"], Math.PI / 2);
});

test("a fence is drawn on the map, checked, and sent", async () => {
  await tab("Fly");
  await take();
  await expectText(page, ".bounds .why", /Click the map to add corners/); // else a click draws nothing
  const map = (await page.locator(".fencemap").boundingBox())!;
  const send = page.getByRole("button", { name: "Send fence" });
  const corners = [[0.1, 0.1], [0.9, 0.1], [0.9, 0.9], [0.1, 0.9]] as const;
  for (const [i, [x, y]] of corners.entries()) {
    await page.locator(".fencemap").click({ position: { x: x * map.width, y: y * map.height } });
    await page.locator(".fencemap .corner").nth(i).waitFor();
    await page.waitForTimeout(300); // else it is a double click
    if (i === 0) await expectText(page, ".bounds .why", /three corners at least/);
  }
  await page.locator(".bounds input").nth(1).fill("6");
  await send.click();
  await expectText(page, ".bounds h2", /as it is set/);
  const later = await open(browser, station.url, { name: "bob" });
  await later.getByRole("tab", { name: "Fly" }).click();
  await expectText(later, ".bounds h2", /as it is set/);
  await later.locator(".fencemap .corner").nth(3).waitFor();
  assert.equal(await later.locator(".fencemap .corner").count(), 4);
  assert.equal(await later.locator(".bounds input").nth(1).inputValue(), "6");
  await later.context().close();
  const sent = station.bodies[0] as { fence_m: number[][]; altitude_max_m: number };
  assert.equal(sent.fence_m.length, 4);
  assert.ok(sent.fence_m[0]![1]! > sent.fence_m[2]![1]!, "north is up");
  assert.equal(sent.altitude_max_m, 6);
});

test("the return place is shown, set on the map or as where the vehicle is, and sent", async () => {
  await tab("Fly");
  await expectText(page, '[data-field="home"]', /^0\.0 m east, 0\.0 m north$/);
  await take();
  await page.locator(".returnplace button:not([disabled])", { hasText: "On the map" }).click();
  const map = (await page.locator(".fencemap").boundingBox())!;
  await page.mouse.click(map.x + 0.8 * map.width, map.y + 0.3 * map.height);
  await expectText(page, '[data-field="home"]', /not sent yet/);
  await page.getByRole("button", { name: "Send return place" }).click();
  await expectText(page, '[data-field="home"]', /^\d+\.\d m east, \d+\.\d m north$/);
  const [east, north] = (station.bodies[0] as { position_m: number[] }).position_m;
  assert.ok(east! > 0 && north! > 0, `${east} ${north}`);
  await page.getByRole("button", { name: "Here" }).click();
  await page.getByRole("spinbutton", { name: "north" }).fill("-2.5");
  await page.getByRole("button", { name: "Send return place" }).click();
  await expectText(page, '[data-field="home"]', /-2\.5 m north$/);
});

test("the station's map lies under the fence, with coordinates of the vehicle and the pointer", async () => {
  const side_deg = 0.002;
  const { lat_deg, lon_deg } = origin;
  const [west, east] = [lon_deg - side_deg, lon_deg + side_deg];
  const [south, north] = [lat_deg - side_deg, lat_deg + side_deg];
  station.map.set("map.json", JSON.stringify({ kind: "image", frame: "wgs84", width_px: 8, height_px: 8,
    corners: [[west, north], [east, north], [east, south], [west, south]] }));
  station.map.set("map/image", png({ width: 8, height: 8 }, (x, y) => [20 * x, 90, 20 * y]));
  await page.reload();
  await tab("Fly");
  await page.waitForSelector(".fencemap image");
  const map = (await page.locator(".fencemap").boundingBox())!;
  const image = (await page.locator(".fencemap image").boundingBox())!;
  assert.ok(image.x < map.x && image.x + image.width > map.x + map.width);
  await expectText(page, '[data-field="coordinates"]', /● .* · 52\.5\d{6}° N 13\.4\d{6}° E/);
  await page.mouse.move(map.x + 40, map.y + 40);
  await expectText(page, '[data-field="coordinates"]', /⌖ .* · 52\.5\d{6}° N 13\.4\d{6}° E/);
});

test("the checklist says what is not ready, and take-off is held", async () => {
  await tab("Fly");
  await take();
  await expectText(page, '[data-field="ready"]', /✓ ready/);
  const take_off = page.locator(".checklist .hold").first();
  await take_off.click();
  assert.deepEqual(station.received, []);
  await take_off.dispatchEvent("pointerdown", { button: 0 });
  await page.waitForTimeout(900);
  assert.deepEqual(station.received, ["ada: take_off uav1"]);
  station.killed.add("planning");
  await expectText(page, '[data-field="ready"]', /✗ not ready/, 10000);
  await expectText(page, ".checklist li.red", /planning: silent/);
  assert.ok(await take_off.isDisabled());
});

test("a recording shows its pictures, and nobody can be chosen in it", async () => {
  const bytes = await syntheticRecording({ begin_s: 1_700_000_000, seconds: 5, pictures: true });
  await tab("Recordings");
  await page.setInputFiles('[aria-label="open a recording"]',
    { name: "flight.mcap", mimeType: "application/octet-stream", buffer: Buffer.from(bytes) });
  await page.getByRole("button", { name: "pause" }).click();
  await page.getByRole("button", { name: "picture large" }).click();
  await page.waitForSelector(".people button");
  assert.ok(await page.locator(".people button").first().isDisabled());
  await expectText(page, '[data-field="picture-age"]', /^\d+ ms$/);
  await page.getByRole("button", { name: "End replay" }).click();
});

const showsVideo = (shown: Page = page) => shown.waitForSelector(`${frame}[data-kind="video"]`);

test("the picture is shown as video where it is chosen, and the choice is kept", async () => {
  await page.context().close();
  station.close();
  station = await startStandIn({ vehicles: 1, video: true });
  page = await open(browser, station.url, { name: "ada" });
  await page.waitForSelector(`${frame}[data-kind="image"]`);
  assert.equal(station.videoed.size, 0);
  await page.getByRole("button", { name: "as video" }).click();
  await showsVideo();
  const [painted, before] = [station.painted, await pictures()];
  await page.waitForTimeout(1200);
  assert.ok(await pictures() > before + 5);
  assert.ok(station.painted <= painted + 2, "images are read no more");
  await expectText(page, '[data-field="picture-age"]', /^\d+ ms$/);
  await page.getByRole("button", { name: "picture large" }).click();
  await expectText(page, ".people", /1 · \d\.\d m/);
  await page.reload();
  await showsVideo();
  assert.deepEqual(page.problems, []);
});

test("a video that cannot be decoded gives way to images, with a word", async () => {
  await page.context().close();
  station.close();
  station = await startStandIn({ vehicles: 1, video: true });
  station.videoFault = true;
  page = await open(browser, station.url, { name: "ada" });
  await page.getByRole("button", { name: "as video" }).click();
  await expectText(page, '[data-field="answer"]', /No video: .+ Images are shown/);
  const before = await pictures();
  await page.waitForTimeout(600);
  assert.ok(await pictures() > before + 3);
  assert.equal(await page.getAttribute(frame, "data-kind"), "image");
  station.videoFault = false;
  await page.getByRole("button", { name: "as video" }).click();
  await showsVideo();
});

test("a recorded video is shown from the key picture before the place that is sought", async () => {
  const bytes = await syntheticRecording({ begin_s: 1_700_000_000, seconds: 6, video: true });
  await page.evaluate(() => localStorage.setItem("foretrack.picture", "video"));
  await page.reload();
  await tab("Recordings");
  await page.setInputFiles('[aria-label="open a recording"]',
    { name: "flight.mcap", mimeType: "application/octet-stream", buffer: Buffer.from(bytes) });
  await page.getByRole("button", { name: "pause" }).click();
  await page.fill('[aria-label="go to"]', "4.2"); // keys come at 3.65 s and 4.85 s
  await page.keyboard.press("Enter");
  await page.waitForSelector(`${frame}[data-kind="video"][data-stamp="4.15"]`);
  await expectText(page, '[data-field="picture-age"]', /^\d+ ms$/);
});

test("a snapshot is a PNG with what lies over the picture", async () => {
  await page.waitForSelector(`${frame}[data-pictures]`);
  const [download] = await Promise.all([page.waitForEvent("download"),
    page.getByRole("button", { name: "snapshot" }).click()]);
  assert.match(download.suggestedFilename(), /^uav1_\d+\.png$/);
});

test("a clip of the last seconds that are recorded is asked of the station", async () => {
  const clip = page.getByRole("button", { name: "clip of the last 20 s" });
  const answer = '[data-field="answer"]';
  await page.waitForSelector(`${frame}[data-pictures]`);
  await clip.click();
  await expectText(page, answer, /Nothing is recorded/);
  station.recording = { active: true, file: "today.mcap", bytes: 1, seconds: 50.5 };
  await page.waitForFunction(() =>
    (window as never as { foretrack: any }).foretrack.liveState.station.message.recording !== null);
  const [film] = await Promise.all([page.waitForEvent("download"), clip.click()]);
  assert.equal(film.suggestedFilename(), "today_uav1_31s.webm");
  assert.deepEqual(station.clips, ["/clips/today.webm?vehicle=uav1&from_s=30.50&to_s=50.50"]);
});

test("alarms sound until they are acknowledged, unless they are muted", async () => {
  await page.waitForSelector('[data-vehicle="uav2"]');
  const played = () => page.evaluate("foretrack.sound.played") as Promise<number>;
  assert.equal(await played(), 0);
  station.silent.add("uav2");
  await expectText(page, '[data-alarm="uav2 silent"]', /nothing heard/);
  assert.ok(await played() >= 1);
  await page.keyboard.press("a");
  const before = await played();
  await page.waitForTimeout(4500);
  assert.equal(await played(), before);
  await page.keyboard.press("m");
  assert.equal(await page.evaluate("foretrack.sound.muted"), true);
});

test("on a phone the picture has a tab, and nothing of the new is cut off", async () => {
  const phone = await open(browser, station.url, { width: 390, height: 844, name: "ada" });
  for (const name of ["Picture", "Fly"]) {
    await phone.getByRole("tab", { name, exact: true }).click();
    await phone.waitForTimeout(300);
    assert.ok(await phone.evaluate(() => document.documentElement.scrollWidth) <= 390, name);
    const box = (await phone.locator("button.stop").first().boundingBox())!;
    assert.ok(box.y + box.height <= 844, name);
  }
  const wide = await phone.locator(".table").evaluate((e) => e.scrollWidth - e.clientWidth);
  assert.ok(wide <= 0);
  await phone.context().close();
});
