// browser_age.mjs URL [SECONDS]: how old samples are when the page's browser hands them to the page
// (both clocks are this machine's; the station stamps a sample when it takes it from DDS). JSON.
import { launch, open } from "../tests/chromium.mjs";

const [url, seconds = "15"] = process.argv.slice(2);
const listen = () => {
  const ages = (window.ages = []);
  const Plain = window.WebSocket;
  window.WebSocket = class extends Plain {
    constructor(...given) {
      super(...given);
      this.addEventListener("message", ({ data }) => {
        if (typeof data === "string") return;
        const log_ms = Number(new DataView(data).getBigUint64(5, true)) / 1e6;
        ages.push(performance.timeOrigin + performance.now() - log_ms);
      });
    }
  };
};
for (const scene of [false, true]) {
  const browser = await launch({ scene });
  const page = await open(browser, "about:blank");
  await page.context().addInitScript(listen);
  await page.goto(url);
  await page.waitForSelector("[data-vehicle]");
  await page.waitForTimeout(3000);
  const ages = await page.evaluate(async (wait_ms) => {
    window.ages.length = 0;
    await new Promise((resolve) => setTimeout(resolve, wait_ms));
    return window.ages.sort((a, b) => a - b);
  }, 1000 * Number(seconds));
  const at = (q) => Number(ages[Math.floor(q * (ages.length - 1))].toFixed(1));
  console.log(JSON.stringify({ scene, samples_s: Math.round(ages.length / Number(seconds)),
    age_ms: { p50: at(0.5), p95: at(0.95), p99: at(0.99) } }));
  await browser.close();
}
process.exit(0);
