// SPDX-License-Identifier: Apache-2.0
// picture_age.mjs NEAR [FAR [SECONDS]]: how old a picture is when the page has drawn it, from its image's
// stamp, on the page at NEAR (this machine) and at the same time at FAR (the same station over a link that
// is to be measured; addresses with their token). Stamps are told from this machine's clock by odometry that
// is read at NEAR: what a far page itself takes for its age lacks the way there. JSON.
import { FoxgloveClient } from "@foxglove/ws-protocol";
import WebSocket from "ws";

import { launch, open } from "../tests/chromium.mjs";

const [near, far, seconds = "20"] = process.argv.slice(2);

/** Wall time minus flight time, s: of the quickest odometry. */
function listenToClock(url) {
  const clock = { ahead_s: Infinity };
  const [address, token = ""] = url.split("#");
  const socket = new WebSocket(`${address.replace(/^http/, "ws")}ws?${token}`, ["foxglove.websocket.v1"]);
  const client = new FoxgloveClient({ ws: socket });
  client.on("advertise", (channels) => channels.filter((c) => c.topic.endsWith("/odometry"))
    .slice(0, 1).forEach((c) => client.subscribe(c.id)));
  client.on("message", ({ data }) => { // CDR: the stamp comes first
    const stamp_s = data.getInt32(4, true) + 1e-9 * data.getUint32(8, true);
    clock.ahead_s = Math.min(clock.ahead_s, Date.now() / 1000 - stamp_s);
  });
  return clock;
}

/** In the page: each picture's stamp and when it was there. */
function watch() {
  const drawn = (window.drawn = []);
  const look = () => {
    const stamp = document.querySelector(".camview .frame")?.dataset.stamp;
    if (stamp !== undefined && drawn.at(-1)?.[0] !== stamp) drawn.push([stamp, Date.now() / 1000]);
    requestAnimationFrame(look);
  };
  look();
}

function summary(drawn, clock) {
  const ages = drawn.map(([stamp, at_s]) => at_s - clock.ahead_s - Number(stamp)).sort((a, b) => a - b);
  const at = (q) => Math.round(1000 * ages[Math.floor(q * (ages.length - 1))]);
  return { pictures_s: Number((ages.length / Number(seconds)).toFixed(1)), p50_ms: at(0.5), p95_ms: at(0.95),
    most_ms: at(1) };
}

const clock = listenToClock(near);
const browser = await launch();
const pages = [];
for (const url of [near, ...(far ? [far] : [])]) {
  const page = await open(browser, url);
  await page.waitForSelector(".camview .frame[data-stamp]", { timeout: 120000 });
  pages.push(page);
}
await pages[0].waitForTimeout(5000);
await Promise.all(pages.map((page) => page.evaluate(watch)));
await pages[0].waitForTimeout(1000 * Number(seconds));
const drawn = await Promise.all(pages.map((page) => page.evaluate(() => window.drawn)));
console.log(JSON.stringify({ near: summary(drawn[0], clock), ...(far && { far: summary(drawn[1], clock) }) }));
await browser.close();
process.exit(0);
