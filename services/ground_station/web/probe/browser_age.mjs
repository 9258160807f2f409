// SPDX-License-Identifier: Apache-2.0
// browser_age.mjs URL [SECONDS]: how old samples are when the browser hands them to the page, and when
// they are in the page's state (both clocks are this machine's; the station stamps a sample when it
// takes it from DDS); without the 3-D scene and with it. JSON.
import { launch, open } from "../tests/chromium.mjs";

const [url, seconds = "15"] = process.argv.slice(2);
const listen = () => {
  const ages = (window.ages = { arrived: [], in_state: [] });
  const now_ms = () => performance.timeOrigin + performance.now();
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string") return;
        const log_ms = Number(new DataView(data).getBigUint64(5, true)) / 1e6;
        ages.arrived.push(now_ms() - log_ms);
      });
    }
  };
  window.addEventListener("load", () => {
    const { foretrack: session } = window;
    const frame = session.frame.bind(session);
    const take = session.link.take.bind(session.link);
    let taken = [];
    session.link.take = () => (taken = take());
    session.frame = () => {
      taken = [];
      frame();
      for (const { time_s } of taken) ages.in_state.push(now_ms() - 1000 * time_s);
    };
  });
};
for (const scene of [false, true]) {
  const browser = await launch({ scene });
  const page = await open(browser, "about:blank");
  await page.context().addInitScript(listen);
  await page.goto(url);
  await page.waitForSelector("[data-vehicle]");
  await page.waitForTimeout(4000);
  const ages = await page.evaluate(async (wait_ms) => {
    for (const list of Object.values(window.ages)) list.length = 0;
    await new Promise((resolve) => setTimeout(resolve, wait_ms));
    return window.ages;
  }, 1000 * Number(seconds));
  const round = (list) => {
    list.sort((a, b) => a - b);
    const at = (q) => Number(list[Math.floor(q * (list.length - 1))].toFixed(1));
    return { p50: at(0.5), p95: at(0.95), p99: at(0.99) };
  };
  const fps = await page.evaluate(() => document.querySelector("[data-fps]")?.dataset.fps);
  console.log(JSON.stringify({ scene, samples_s: Math.round(ages.arrived.length / Number(seconds)),
    arrived_ms: round(ages.arrived), in_state_ms: round(ages.in_state), fps: Number(fps) }));
  await browser.close();
}
process.exit(0);
