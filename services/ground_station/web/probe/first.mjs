// SPDX-License-Identifier: Apache-2.0
// first.mjs URL [TIMES [watched]]: where the time goes until a page's first picture is drawn, ms from its opening: html, main.js,
// the first WebSocket made and open, channels known, first picture there, decoded, drawn. "watched": beside another page,
// so that the vehicle encodes pictures already.
import { firstPicture_ms, launch, open } from "../tests/chromium.mjs";

const [url, times = "4", watched] = process.argv.slice(2);
const picture_bytes = 3000;

const listen = (least_bytes) => {
  const marks = (window.marks = {});
  const mark = (name) => (marks[name] ??= Math.round(performance.now()));
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...given) {
      super(...given);
      mark("made");
      this.addEventListener("open", () => mark("open"));
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string") return data.includes('"advertise"') && mark("channels");
        if (data.byteLength > least_bytes) mark("picture");
      });
    }
  };
  const decode = window.createImageBitmap;
  window.createImageBitmap = async (...given) => {
    const bitmap = await decode(...given);
    mark("decoded");
    return bitmap;
  };
};

const browser = await launch();
if (watched) await open(browser, url);
for (let i = 0; i < Number(times); i++) {
  await new Promise((done) => setTimeout(done, watched ? 1000 : 5000));
  const context = await browser.newContext({ viewport: { width: 1440, height: 900 } });
  await context.addInitScript(listen, picture_bytes);
  const page = await context.newPage();
  await page.goto(url);
  const drawn = await firstPicture_ms(page);
  await page.waitForSelector(".camview .frame[data-stamp]", { timeout: 40000 });
  console.log(JSON.stringify(await page.evaluate((drawn) => {
    const [html] = performance.getEntriesByType("navigation");
    const [main] = performance.getEntriesByName(new URL("main.js", location.href).href);
    return { html: Math.round(html.responseEnd), main: Math.round(main.responseEnd), ...window.marks, drawn,
      page: Math.round(performance.now()) };
  }, drawn)));
  await context.close();
}
await browser.close();
process.exit(0);
