// SPDX-License-Identifier: Apache-2.0
// Debian's Chromium by playwright-core.
import { existsSync } from "node:fs";
import { chromium } from "playwright-core";

export const chromiumPath = process.env["CHROMIUM"] ?? "/usr/bin/chromium";
export const hasChromium = existsSync(chromiumPath);

const graphics = (scene) => scene ? ["--enable-unsafe-swiftshader"]
  : ["--disable-gpu", "--disable-software-rasterizer"];

/** Without the graphics library the scene says so and all else is quick. */
export async function launch({ scene = false } = {}) {
  return chromium.launch({ executablePath: chromiumPath,
    args: ["--no-sandbox", "--disable-dev-shm-usage", ...graphics(scene)] });
}

/** A page of its own browser context; its errors are kept in page.problems. */
export async function open(browser, url, { width = 1440, height = 900, name } = {}) {
  const context = await browser.newContext({ viewport: { width, height } });
  if (name)
    await context.addInitScript((who) => localStorage.setItem("foretrack.operator", who), name);
  const page = await context.newPage();
  page.setDefaultTimeout(40000);
  page.problems = [];
  page.on("pageerror", (error) => page.problems.push(String(error)));
  page.on("console", (message) => {
    const text = message.text();
    const expected = /WebGL|ERR_CONNECTION_REFUSED/.test(text);
    if (message.type() === "error" && !expected) page.problems.push(text);
  });
  await page.goto(url);
  return page;
}

/** When the page drew its first picture, ms after it was opened; waits for it. */
export async function firstPicture_ms(page) {
  const marked = await page.waitForFunction(() => performance.getEntriesByName("first picture")[0]?.startTime);
  return Math.round(await marked.jsonValue());
}

/** Waits until the text of a field fits; throws with what it is instead. */
export async function expectText(page, selector, pattern, timeout = 30000) {
  const field = page.locator(selector).first();
  const end = Date.now() + timeout;
  let text = "";
  while (Date.now() < end) {
    text = (await field.textContent({ timeout: 1000 }).catch(() => null)) ?? "(absent)";
    if (pattern.test(text)) return text;
    await page.waitForTimeout(100);
  }
  throw new Error(`${selector}: ${pattern} expected, but it says: ${text}`);
}
