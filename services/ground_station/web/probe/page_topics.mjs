// SPDX-License-Identifier: Apache-2.0
// page_topics.mjs URL: opens the station's page in a browser and prints the rows of its list of
// topics that warn of something, as JSON { topic: text }, once there are two.
import { hasChromium, launch, open } from "../tests/chromium.mjs";

if (!hasChromium) {
  console.log(JSON.stringify({ skipped: "no Chromium" }));
  process.exit(0);
}
const browser = await launch();
const page = await open(browser, process.argv[2]);
await page.getByRole("tab", { name: "Topics" }).click();
const rows = () => page.locator("[data-topic]").evaluateAll((all) => Object.fromEntries(
  all.map((row) => [row.dataset.topic, row.textContent])));
const warning = (row) => /QoS mismatch|foreign/.test(row);
let found = {};
for (let i = 0; i < 150 && Object.values(found).filter(warning).length < 2; i++) {
  await page.waitForTimeout(100);
  found = await rows();
}
await page.getByRole("tab", { name: "Events" }).click();
await page.waitForTimeout(500);
const alarms = await page.locator("[data-alarm]").allTextContents();
console.log(JSON.stringify({ rows: found, alarms }));
await browser.close();
process.exit(0);
