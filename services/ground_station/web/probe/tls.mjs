// SPDX-License-Identifier: Apache-2.0
// tls.mjs HOST:PORT CERTIFICATE TOKEN: what a station that wants TLS answers to whom, as JSON.
import { readFileSync } from "node:fs";
import { request as plainRequest } from "node:http";
import { request } from "node:https";

import WebSocket from "ws";

const [address, certificate, token] = process.argv.slice(2);
const ca = readFileSync(certificate);
const bearer = { Authorization: `Bearer ${token}` };

/** The status code, or why there is none. */
function ask(how, url, options) {
  return new Promise((resolve) => {
    const asked = how(url, options, (response) => {
      response.resume();
      resolve(response.statusCode);
    });
    asked.on("error", (error) => resolve(error.code ?? String(error)));
    asked.setTimeout(5000, () => asked.destroy(new Error("no answer")));
    asked.end();
  });
}

/** The first message's op, or why there is none. */
function connect(url, options) {
  return new Promise((resolve) => {
    const socket = new WebSocket(url, ["foxglove.websocket.v1"], { handshakeTimeout: 5000, ...options });
    socket.on("message", (data) => {
      resolve(JSON.parse(data).op);
      socket.terminate();
    });
    socket.on("unexpected-response", (_request, response) => resolve(response.statusCode));
    socket.on("error", (error) => resolve(error.code ?? String(error)));
  });
}

const status = `https://${address}/api/status`;
const old = { maxVersion: "TLSv1.1", minVersion: "TLSv1", ciphers: "DEFAULT@SECLEVEL=0" };
console.log(JSON.stringify({
  trusted: await ask(request, status, { ca, headers: bearer }),
  without_token: await ask(request, status, { ca }),
  wrong_token: await ask(request, status, { ca, headers: { Authorization: `Bearer ${"0".repeat(64)}` } }),
  page: await ask(request, `https://${address}/`, { ca }),
  untrusted: await ask(request, status, { headers: bearer }),
  old_tls: await ask(request, status, { ca, headers: bearer, ...old }),
  in_the_clear: await ask(plainRequest, `http://${address}/api/status`, { headers: bearer }),
  wss: await connect(`wss://${address}/ws?token=${token}`, { ca }),
  wss_without_token: await connect(`wss://${address}/ws`, { ca }),
  wss_untrusted: await connect(`wss://${address}/ws?token=${token}`, {}),
  ws_in_the_clear: await connect(`ws://${address}/ws?token=${token}`, {}),
}));
process.exit(0);
