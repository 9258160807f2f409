// SPDX-License-Identifier: Apache-2.0
// Chromium without a debugger that follows its network, as an operator has it. Playwright is told
// of every WebSocket frame with all that is in it, which takes a tenth of what all else takes.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import WebSocket from "ws";

import { chromiumPath } from "../tests/chromium.mjs";

/** Sends commands of the DevTools protocol; keeps the sessions of what it is attached to. */
class Debugger {
  sessions = new Map(); // kind of target → session
  #waiting = new Map();
  #last = 0;

  constructor(socket) {
    this.socket = socket;
    socket.on("message", (data) => this.#hear(JSON.parse(data.toString())));
  }

  #hear({ id, method, params, result, error }) {
    if (method === "Target.attachedToTarget")
      this.sessions.set(params.targetInfo.type, params.sessionId);
    const waiting = this.#waiting.get(id);
    this.#waiting.delete(id);
    if (error) waiting?.reject(new Error(error.message));
    else waiting?.resolve(result);
  }

  send(method, params = {}, target = "page") {
    const id = ++this.#last;
    this.socket.send(JSON.stringify({ id, method, params, sessionId: this.sessions.get(target) }));
    return new Promise((resolve, reject) => this.#waiting.set(id, { resolve, reject }));
  }
}

function addressOf(child) {
  return new Promise((resolve, reject) => {
    let said = "";
    child.stderr.on("data", (data) => {
      said += data;
      const found = /listening on (ws:\S+)/.exec(said);
      if (found) resolve(found[1]);
    });
    child.once("exit", () => reject(new Error(`chromium ended: ${said}`)));
  });
}

/** The page at an address, drawn by software. */
export async function openBare(url, { width = 1440, height = 900 } = {}) {
  const folder = mkdtempSync(join(tmpdir(), "foretrack-page-"));
  const child = spawn(chromiumPath, ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage",
    "--enable-unsafe-swiftshader", "--no-first-run", "--disable-background-networking",
    "--disable-component-update", "--remote-debugging-port=0", `--user-data-dir=${folder}`,
    "about:blank"], { stdio: ["ignore", "ignore", "pipe"] });
  const socket = new WebSocket(await addressOf(child), { perMessageDeflate: false });
  await new Promise((resolve) => socket.once("open", resolve));
  const debug = new Debugger(socket);
  const { targetInfos } = await debug.send("Target.getTargets");
  const { targetId } = targetInfos.find(({ type }) => type === "page");
  await debug.send("Target.attachToTarget", { targetId, flatten: true });
  await debug.send("Emulation.setDeviceMetricsOverride",
    { width, height, deviceScaleFactor: 1, mobile: false });
  await debug.send("Target.setAutoAttach",
    { autoAttach: true, waitForDebuggerOnStart: false, flatten: true });
  await debug.send("Page.navigate", { url });
  return {
    /** The result of a function without parameters, in the page or its worker. */
    async evaluate(script, target = "page") {
      const { result, exceptionDetails } = await debug.send("Runtime.evaluate",
        { expression: `(${script})()`, awaitPromise: true, returnByValue: true }, target);
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description);
      return result.value;
    },
    async screenshot(path) {
      const { data } = await debug.send("Page.captureScreenshot");
      writeFileSync(path, Buffer.from(data, "base64"));
    },
    async close() {
      const ended = new Promise((resolve) => child.once("exit", resolve));
      child.kill();
      await ended;
      rmSync(folder, { recursive: true, force: true, maxRetries: 10 });
    },
  };
}
