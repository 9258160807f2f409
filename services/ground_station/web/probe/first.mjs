// temp
import { launch, open } from "../tests/chromium.mjs";
const [url, n = "4", keep] = process.argv.slice(2);
const browser = await launch();
if (keep) await open(browser, url);
await new Promise((r) => setTimeout(r, 6000));
const hook = () => {
  const m = (window.marks = {}); const now = () => Math.round(performance.now());
  m.script = now();
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain { constructor(...a) { super(...a); m.ws ??= now();
    this.addEventListener("open", () => (m.open ??= now()));
    this.addEventListener("message", ({ data }) => { if (typeof data === "string") { if (data.includes("advertise")) m.advertise ??= now(); } else { m.sample ??= now(); if (data.byteLength > 6000) m.big ??= now(); } }); } };
  const draw = window.createImageBitmap; window.createImageBitmap = async (...a) => { m.decode ??= now(); const r = await draw(...a); m.decoded ??= now(); return r; };
  document.addEventListener("DOMContentLoaded", () => (m.dom = now()));
};
for (let i = 0; i < Number(n); i++) {
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  await context.addInitScript(hook);
  const page = await context.newPage();
  await page.goto(url);
  await page.waitForSelector(".camview .frame[data-first]", { timeout: 20000 });
  const first = await page.getAttribute(".camview .frame", "data-first");
  console.log(first, JSON.stringify(await page.evaluate(() => { const n = performance.getEntriesByType("navigation")[0]; const r = performance.getEntriesByName(location.origin + "/main.js")[0]; const paint = performance.getEntriesByType("paint").map((p) => [p.name, Math.round(p.startTime)]); return { ...window.marks, html: Math.round(n.responseEnd), main: r && Math.round(r.responseEnd), paint }; })));
  await context.close();
  await new Promise((r) => setTimeout(r, keep ? 500 : 5000));
}
await browser.close(); process.exit(0);
