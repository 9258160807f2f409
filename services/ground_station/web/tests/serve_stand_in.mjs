// SPDX-License-Identifier: Apache-2.0
// node tests/serve_stand_in.mjs [PORT] [VEHICLES]: the page on a made-up flight, to work on it.
import { startStandIn } from "./stand_in.mjs";

const [port = 8090, vehicles = 1] = process.argv.slice(2).map(Number);
console.log((await startStandIn({ port, vehicles })).url);
