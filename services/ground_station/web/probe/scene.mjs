// SPDX-License-Identifier: Apache-2.0
// scene.mjs [VEHICLES [SECONDS [video]]]: frames a second of the page's scene on a made-up flight, in a
// browser without a graphics card; draw calls, what a frame costs the page's own script and each
// process, how much of the machine others took, and how long one picture takes to draw at several
// ratios of pixels. JSON.
import { readdirSync, readFileSync } from "node:fs";
import { setTimeout as wait } from "node:timers/promises";

import { startStandIn } from "../tests/stand_in.mjs";
import { openBare } from "./bare_browser.mjs";

/** Seconds of processor that each kind of the browser's processes, and this one, have had. */
function processor() {
  const spent = { page: 0, graphics: 0, browser: 0, made_up_flight: 0 };
  const { user, system } = process.cpuUsage();
  spent.made_up_flight = (user + system) / 1e6;
  for (const pid of readdirSync("/proc").filter((name) => /^\d+$/.test(name))) {
    try {
      const command = readFileSync(`/proc/${pid}/cmdline`, "utf8");
      if (!command.includes("chromium")) continue;
      const fields = readFileSync(`/proc/${pid}/stat`, "utf8").split(") ")[1].split(" ");
      const kind = command.includes("--type=renderer") ? "page"
        : command.includes("--type=gpu-process") ? "graphics" : "browser";
      spent[kind] += (Number(fields[11]) + Number(fields[12])) / 100;
    } catch { /* it has ended */ }
  }
  return spent;
}

/** Seconds of processor that all have had, and those taken from the machine itself. */
function machine() {
  const line = readFileSync("/proc/stat", "utf8").split("\n")[0];
  const jiffies = line.split(/\s+/).slice(1).map(Number);
  const [user, nice, system, , , irq, softirq, stolen] = jiffies;
  return { busy: (user + nice + system + irq + softirq) / 100, stolen: stolen / 100 };
}

/** In the worker: milliseconds of one picture until it is there, by ratio; nothing new to show. */
function raster() {
  const { renderer, scene, camera } = self.view;
  self.view.halt();
  const gl = renderer.getContext();
  const draw_ms = () => {
    const begin_ms = performance.now();
    renderer.render(scene, camera);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for it
    return performance.now() - begin_ms;
  };
  const middle = (ratio) => {
    renderer.setPixelRatio(ratio);
    const times = Array.from({ length: 30 }, draw_ms).slice(5).sort((a, b) => a - b);
    return Number(times[12].toFixed(1));
  };
  return Object.fromEntries([2, 1, 0.75, 0.5].map((ratio) => [ratio, middle(ratio)]));
}

const counts = () => ({ ...document.querySelector("[data-first]")?.dataset });

const [vehicles = 8, seconds = 15] = process.argv.slice(2, 4).map(Number);
const video = process.argv[4] === "video"; // the picture beside it
const station = await startStandIn({ vehicles, video });
const page = await openBare(station.url, process.env["PHONE"] ? { width: 390, height: 844 } : {});
let first_ms;
while ((first_ms = (await page.evaluate(counts)).first) === undefined) await wait(50);
if (video) await page.evaluate(() => void (window.foretrack.video.wanted = true));
await wait(5000);
const picture = () => ({ ...document.querySelector(".camview .frame")?.dataset });
const pictured = await page.evaluate(picture);
const samples = [];
const [before, all_before] = [processor(), machine()];
for (let i = 0; i < seconds; i++) {
  await wait(1000);
  samples.push(await page.evaluate(counts));
}
const [after, all_after] = [processor(), machine()];
const sum = (spent) => Object.values(spent).reduce((all, s) => all + s, 0);
const others = all_after.busy - all_before.busy - sum(after) + sum(before)
  + all_after.stolen - all_before.stolen;
const middle = (key) => {
  const sorted = samples.map((s) => Number(s[key])).sort((a, b) => a - b);
  return sorted[sorted.length >> 1];
};
if (process.env["SHOT"]) await page.screenshot(process.env["SHOT"]);
const frames = samples.reduce((sum, s) => sum + Number(s.fps), 0);
const cpu_ms_a_frame = Object.fromEntries(Object.keys(after).map((kind) =>
  [kind, Number((1000 * (after[kind] - before[kind]) / frames).toFixed(1))]));
console.log(JSON.stringify({ vehicles, first_picture_ms: Number(first_ms), fps: middle("fps"),
  fps_all: samples.map((s) => Number(s.fps)), calls: middle("calls"),
  triangles: middle("triangles"), script_ms: middle("script"), busy_ms: middle("busy"),
  ratio: middle("ratio"), picture: pictured.kind,
  pictures_s: (Number((await page.evaluate(picture)).pictures) - Number(pictured.pictures)) / seconds, cpu_ms_a_frame, cores_of_others: Number((others / seconds).toFixed(2)),
  raster_ms: await page.evaluate(raster, "worker") }));
await page.close();
station.close();
process.exit(0);
