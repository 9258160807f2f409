// SPDX-License-Identifier: Apache-2.0
// picture_age.mjs NEAR [FAR [SECONDS]]: how old a picture is when the page has drawn it, from its image's
// stamp, on the page at NEAR (this machine) and at the same time at FAR (the same station over a link that
// is to be measured; addresses with their token). When it was that time in the flight, odometry tells that is
// read at NEAR: what a far page itself takes for the age lacks the way there, and a simulated flight's clock
// may be slower than this machine's. JSON.
import protocol from "@foxglove/ws-protocol";
import WebSocket from "ws";

import { launch, open } from "../tests/chromium.mjs";

const { FoxgloveClient } = protocol;
const [near, far, seconds = "20"] = process.argv.slice(2);

/** Stamps of odometry and when they were here, s. */
function listenToClock(url) {
  const clock = [];
  const [address, token = ""] = url.split("#");
  const socket = new WebSocket(`${address.replace(/^http/, "ws")}ws?${token}`, ["foxglove.websocket.v1"]);
  const client = new FoxgloveClient({ ws: socket });
  client.on("advertise", (channels) => channels.filter((c) => c.topic.endsWith("/odometry"))
    .slice(0, 1).forEach((c) => client.subscribe(c.id)));
  client.on("message", ({ data }) => { // CDR: the stamp comes first
    const stamp_s = data.getInt32(4, true) + 1e-9 * data.getUint32(8, true);
    clock.push([stamp_s, Date.now() / 1000]);
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
  const ages = drawn.map(([stamp, at_s]) => {
    const then = clock.findLast(([stamp_s, here_s], i) => here_s <= at_s && stamp_s >= Number(stamp) &&
      (clock[i - 1]?.[0] ?? -Infinity) < Number(stamp)); // a recording may come again
    return then ? at_s - then[1] : NaN;
  }).filter(Number.isFinite).sort((a, b) => a - b);
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
