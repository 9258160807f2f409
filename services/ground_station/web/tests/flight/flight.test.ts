// SPDX-License-Identifier: Apache-2.0
// The page on real flights over DDS: two vehicles, the station, a browser, and an observer that
// hears the same topics.
import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { resolve } from "node:path";
import { after, before, test } from "node:test";
import type { Browser, Page } from "playwright-core";

import type { BatteryStatus, Odometry, PlannedTrajectory, SafetyState, ServiceHealth, TargetIntention,
  TargetState, VehicleLocalPosition,
} from "../../src/data/messages.ts";
import { explainGate, modeWord, phaseWord, planWord, trackWord } from "../../src/data/words.ts";
import { toWgs84 } from "../../src/ground/place.ts";
import { distance_m, speed_mps } from "../../src/store/derive.ts";
import { expectText, launch, open } from "../chromium.mjs";
import { Observer } from "./observer.ts";
import { Flight, stationOffers } from "./program.ts";

const onboard = ["perception", "mapping", "prediction", "planning", "safety_gate"];
const second = ["--clock-topic", "uav2/clock", "--px4-namespace", "px4_2"];
const control = stationOffers("--enable-control");
const shots = process.env["FORETRACK_SHOTS"];
const localPosition = "/fmu/out/vehicle_local_position";
const patience_ms = 40000;

const flight = new Flight();
let browser: Browser;
let page: Page & { problems: string[] };
let observer: Observer;
let address: string;

const card = (name: string, field: string): string =>
  `[data-vehicle="${name}"] [data-field="${field}"]`;
const tab = (name: string) => page.getByRole("tab", { name }).click();
const says = (selector: string, pattern: RegExp) =>
  expectText(page, selector, pattern, patience_ms);

async function shot(name: string, of: Page = page): Promise<void> {
  if (!shots) return;
  mkdirSync(shots, { recursive: true });
  await of.screenshot({ path: `${shots}/${name}.png`, timeout: 60000 });
}

/** Tries until it holds; the last failure otherwise. */
async function eventually(check: () => Promise<void> | void): Promise<void> {
  const end = Date.now() + patience_ms;
  for (;;) {
    try {
      return await check();
    } catch (error) {
      if (Date.now() > end) throw error;
      await page.waitForTimeout(200);
    }
  }
}

/** An order is carried out once; on a busy machine it may be given up, and is given again. */
async function fly(name: string): Promise<void> {
  try {
    await eventually(async () => {
      const { mode, phase } = observer.last<SafetyState>(`/${name}/safety/state`).at(-1)!;
      if (phaseWord(phase) === "idle") {
        flight.order(name, "start");
        await page.waitForTimeout(3000);
      }
      assert.equal(modeWord(mode), "track");
    });
  } catch (error) {
    console.log(flight.output);
    throw error;
  }
}

before(async () => {
  for (const service of onboard) flight.service("uav1", service);
  flight.service("uav1", "simulator", "--scenario", "t_intersection", "--map", "depth",
    "--endless");
  flight.service("uav2", "stages", "--no-mapping", ...second);
  flight.service("uav2", "safety_gate", ...second);
  flight.service("uav2", "simulator", "--scenario", "open_field", "--map", "known", "--endless",
    ...second);
  for (const name of ["uav1", "uav2"]) flight.order(name, "start");
  address = await flight.station("--page", resolve("dist"),
    ...(control ? ["--enable-control", "--print-token", "--token-file", "tokens",
      "--audit-file", "audit"] : []));
  observer = new Observer(address);
  browser = await launch();
  page = await open(browser, address, { name: "ada" });
  await page.waitForSelector('[data-vehicle="uav2"]', { timeout: patience_ms });
});
after(async () => {
  await browser?.close();
  observer?.close();
  await flight.end();
});

test("both vehicles fly, and their cards say what their gates and services say", async () => {
  for (const name of ["uav1", "uav2"]) {
    await fly(name);
    await says(card(name, "mode"), /^track$/);
    await eventually(async () => {
      const { mode, phase } = observer.last<SafetyState>(`/${name}/safety/state`).at(-1)!;
      assert.equal(await page.textContent(card(name, "mode")), modeWord(mode));
      assert.equal((await page.textContent(card(name, "phase")))!.trim(), phaseWord(phase));
    });
  }
  await says(card("uav1", "health"), /6 services well/);
});

test("rates on the card are those on the bus", async () => {
  await eventually(async () => {
    const text = await page.textContent(card("uav1", "rates"));
    const told = text!.match(/\d+/g)!.map(Number);
    ["odometry", "target/state", "plan/trajectory"].forEach((topic, i) => {
      const heard = observer.rate_hz(`/uav1/${topic}`);
      assert.ok(Math.abs(told[i]! - heard) < 5 + 0.35 * heard, `${topic}: ${text}, heard ${heard}`);
    });
  });
});

test("the readout and the plots say what the topics say", async () => {
  await page.click('[data-vehicle="uav1"]');
  await eventually(async () => {
    const target = observer.last<TargetState>("/uav1/target/state").at(-1)!;
    assert.equal(await page.textContent('[data-field="person"]'), trackWord(target.status));
    const plan = observer.last<PlannedTrajectory>("/uav1/plan/trajectory").at(-1)!;
    assert.equal(await page.textContent('[data-field="plan"]'), planWord(plan.status));
  });
  await eventually(async () => {
    const text = await page.textContent('[data-field="distance"]');
    const odometries = observer.last<Odometry>("/uav1/odometry", 3);
    const targets = observer.last<TargetState>("/uav1/target/state", 3);
    const heard = targets.flatMap((t) => odometries.map((o) => distance_m(o, t)!));
    assertWithin(parseFloat(text!), heard, 0.006);
    const plotted = await page.textContent('[data-chart="Distance"] .values');
    assertWithin(parseFloat(plotted!), heard, 0.006);
  });
  await eventually(async () => {
    const last = observer.last<TargetIntention>("/uav1/target/intention", 3);
    for (const { name } of last.at(-1)!.intentions) {
      const text = await page.getAttribute(`[data-field="p-${name}"]`, "data-value");
      const heard = last.map((m) => m.intentions.find((i) => i.name === name)!.probability);
      assertWithin(Number(text), heard, 0.0006);
    }
  });
  await eventually(async () => {
    const text = await page.textContent('[data-chart="Plan time"] [data-line="optimization"]');
    const heard = observer.last<PlannedTrajectory>("/uav1/plan/trajectory", 3)
      .map((m) => m.stage_times.find((s) => s.stage === "optimization")!.ms);
    assertWithin(parseFloat(text!.replace("optimization", "")), heard, 0.06);
  });
});

function assertWithin(value: number, heard: number[], tolerance: number): void {
  const [low, high] = [Math.min(...heard) - tolerance, Math.max(...heard) + tolerance];
  assert.ok(value >= low && value <= high, `${value} is not in ${low} … ${high}`);
}

test("diagnostics and topics are listed as they are on the bus", async () => {
  await tab("Diagnostics");
  await eventually(async () => {
    const heard = observer.last<ServiceHealth>("/uav1/health");
    const services = new Map(heard.map((health) => [health.service, health]));
    assert.equal(services.size, 6);
    for (const [service, health] of services) {
      const row = await page.textContent(`[data-service="${service}"]`);
      assert.match(row!, /running/);
      assert.ok(row!.includes(`${(Number(health.rss_bytes) / 1e6).toFixed(1)} MB`), row!);
    }
  });
  await shot("diagnostics");
  await tab("Topics");
  await eventually(async () => {
    for (const topic of observer.topics().filter((t) => t.startsWith("/uav")))
      assert.equal(await page.locator(`[data-topic="${topic.slice(1)}"]`).count(), 1, topic);
    const text = await page.textContent('[data-topic="uav1/target/state"] [data-field="rate"]');
    const heard = observer.rate_hz("/uav1/target/state");
    assert.ok(Math.abs(parseFloat(text!) - heard) < 5 + 0.35 * heard, `${text}, heard ${heard}`);
  });
  await shot("topics");
  await tab("Events");
});

test("a killed service is an alarm, the gate says why it left the track, both end", async () => {
  flight.signal("SIGKILL", "uav1 planning");
  await says('[data-alarm="uav1 service silent planning"]', /planning: silent for \d+ s/);
  await says(card("uav1", "health"), /planning silent/);
  await says('[data-chart="States"] .values', /gate (coast|hover|brake): /);
  const { mode, reason } = observer.last<SafetyState>("/uav1/safety/state").at(-1)!;
  await says('[data-alarm="uav1 gate"]', new RegExp(`${modeWord(mode)}, ${explainGate(reason)}`));
  await shot("killed_service");
  flight.service("uav1", "planning");
  await says('[data-alarm="uav1 service silent planning"]', /over at/);
});

test("a vehicle out of reach dims while the other goes on", async () => {
  const processes = ["uav2 stages", "uav2 safety_gate", "uav2 simulator"];
  flight.signal("SIGSTOP", ...processes);
  await says('[data-alarm="uav2 silent"]', /nothing heard for \d+ s/);
  await says('[data-vehicle="uav2"] .stale .age', /s old/);
  await says(card("uav1", "link"), /^[01]\.\d s$/);
  flight.signal("SIGCONT", ...processes);
  await says('[data-alarm="uav2 silent"]', /over at/);
});

test("without a word from the station the page says so, and comes back", async () => {
  flight.signal("SIGSTOP", "station");
  await says('[data-field="station"]', /no station/);
  await says('[data-vehicle="uav1"] .stale .age', /s old/);
  await shot("lost_link");
  flight.signal("SIGCONT", "station");
  await says('[data-field="station"]', /live/);
  await says(card("uav1", "link"), /^[01]\.\d s$/);
});

const controlled = { skip: !control };

test("battery, speed and coordinates are those of the topics", async () => {
  await tab("Fly");
  await eventually(async () => {
    const told = await page.textContent(card("uav1", "battery"));
    const heard = observer.last<BatteryStatus>("/fmu/out/battery_status").at(-1)!;
    assert.ok(told!.includes(`${Math.round(100 * heard.remaining)} %`), told!);
    assert.ok(told!.includes(`${heard.voltage_v.toFixed(1)} V`), told!);
  });
  await eventually(async () => {
    const plotted = await page.textContent('[data-chart="Speed"] .values');
    const told = Number(/vehicle ([\d.]+) m\/s/.exec(plotted!)![1]);
    assertWithin(told, observer.last<Odometry>("/uav1/odometry", 2).map(speed_mps), 0.006);
  });
  await eventually(async () => {
    const { ref_lat, ref_lon } = observer.last<VehicleLocalPosition>(localPosition).at(-1)!;
    const text = await page.textContent('[data-field="coordinates"]');
    const [, lat, lon] = /([\d.]+)° N ([\d.]+)° E/.exec(text!)!.map(Number);
    const places = observer.last<Odometry>("/uav1/odometry", 3).map(({ pose }) =>
      toWgs84({ lat_deg: ref_lat, lon_deg: ref_lon }, [pose.pose.position.x, pose.pose.position.y]));
    assertWithin(lat!, places.map((p) => p.lat_deg), 1e-7);
    assertWithin(lon!, places.map((p) => p.lon_deg), 1e-7);
  });
});

test("fence, altitudes, return place and framing are those that the gate tells", controlled, async () => {
  const give = (command: string, details: object) => page.evaluate(async ([name, more]) => {
    const { operator } = (window as never as { foretrack: any }).foretrack;
    await operator.lease("uav1", "take");
    return operator.command("uav1", name, more);
  }, [command, details] as const);
  const gate = () => observer.last<SafetyState>("/uav1/safety/state").at(-1)!;
  const fence_m = [[-60, -60], [60, -60], [60, 60], [-60, 60]];
  const bounds = { fence_m, altitude_min_m: null, altitude_max_m: 9.5 };
  const taken = await give("bounds", bounds) as { ok: boolean; reason: string };
  assert.ok(taken.ok, taken.reason);
  await eventually(async () => {
    assert.deepEqual(Array.from(gate().fence_m!), fence_m.flat());
    assert.equal(await page.locator(".fencemap .corner").count(), gate().fence_m!.length / 2);
    const altitudes = await page.locator(".bounds input").evaluateAll((inputs) =>
      inputs.slice(0, 2).map((input) => (input as HTMLInputElement).value));
    assert.deepEqual(altitudes, ["", `${gate().altitude_max_m}`]);
  });
  await give("return_place", { position_m: [3, -2] });
  await eventually(async () => {
    assert.ok(gate().home_known);
    const [east, north] = Array.from(gate().home_m!) as [number, number];
    assert.ok(Math.hypot(east - 3, north + 2) < 0.05, `${east} ${north}`);
    assert.equal(await page.textContent('[data-field="home"]'),
      `${east.toFixed(1)} m east, ${north.toFixed(1)} m north`);
  });
  const outside = await give("return_place", { position_m: [90, 0] }) as { ok: boolean; reason: string };
  assert.equal(outside.ok, false);
  assert.match(outside.reason, /refused: this place is outside of the fence/);
  page.problems.length = 0; // the browser says of a refusal that it is HTTP 409
  await give("framing", { distance_m: 2.2, height_m: null, bearing_rad: null, circling_radps: 0 });
  await eventually(async () => {
    assert.equal(gate().framing!.distance_m, 2.2);
    assert.match((await page.textContent('[data-field="framing"]'))!, /2\.2 m/);
  });
  await give("bounds", { fence_m: [], altitude_min_m: null, altitude_max_m: null });
  await page.evaluate(() => (window as never as { foretrack: any }).foretrack.operator.lease("uav1", "release"));
  await tab("Events");
});

test("control is handed over, and STOP halts the vehicle without it", controlled, async () => {
  const other = await open(browser, address, { name: "bob" });
  await page.getByRole("button", { name: "Take control" }).click();
  await expectText(other, card("uav1", "lease"), /ada/, patience_ms);
  await expectText(other, '[data-field="answer"]', /ada has control/);
  await tab("Control");
  await page.fill('[aria-label="hand over uav1 to"]', "bob");
  await page.getByRole("button", { name: "Hand over" }).click();
  await says(card("uav1", "lease"), /bob/);
  await other.getByRole("button", { name: "Hold", exact: true }).click();
  await says(card("uav1", "phase"), /holding/);
  await page.locator(".bar button.stop").dispatchEvent("pointerdown", { button: 0 });
  await says(card("uav1", "phase"), /stopped/);
  await eventually(() => {
    const { linear: v } = observer.last<Odometry>("/uav1/odometry").at(-1)!.twist.twist;
    assert.ok(Math.hypot(v.x, v.y, v.z) < 0.2);
  });
  await shot("stopped");
  await other.context().close();
});

test("a recording of the station is replayed", controlled, async () => {
  await tab("Recordings");
  await page.getByRole("button", { name: "Record", exact: true }).click();
  await says('[data-field="recording"]', /0:0[3-9]/);
  await page.getByRole("button", { name: "Stop recording" }).click();
  await page.getByRole("button", { name: "Replay" }).first().click();
  await says('[data-field="replay-time"]', /0:0[1-9]/);
  await page.getByRole("button", { name: "pause" }).click();
  await says(card("uav1", "phase"), /stopped/);
  await shot("replay");
  await page.getByRole("button", { name: "End replay" }).click();
  assert.deepEqual(page.problems, []);
});
