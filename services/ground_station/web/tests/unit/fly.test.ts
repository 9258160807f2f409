// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import type { SafetyState } from "../../src/data/messages.ts";
import { contains, type Corner, faultOf, mapAround, scaleOf, toMetres, toPixel, zoomed,
} from "../../src/fly/fence.ts";
import { framingOf, framingText, free, limitsOf, presets, limits, same, sideOf } from "../../src/fly/framing.ts";
import { checklist, isReady, reactions } from "../../src/fly/checklist.ts";
import { boundsOf, homeOf } from "../../src/store/derive.ts";
import { reduce } from "../../src/store/reduce.ts";
import { diagnosticsOf, safety, samplesAt } from "../synthetic.mjs";
import { fold, sample } from "./make.ts";

const square: Corner[] = [[0, 0], [10, 0], [10, 10], [0, 10]];

test("a fence is drawn in metres with north up", () => {
  const map = mapAround([[0, 0], [40, 10]], 400, 300);
  const corner: Corner = [12, -3];
  const back = toMetres(map, toPixel(map, corner));
  assert.ok(Math.hypot(back[0] - 12, back[1] + 3) < 1e-9);
  assert.ok(toPixel(map, [0, 5])[1] < toPixel(map, [0, 0])[1]);
  for (const point of [[0, 0], [40, 10]] as Corner[]) {
    const [x, y] = toPixel(map, point);
    assert.ok(x >= 0 && x <= 400 && y >= 0 && y <= 300);
  }
});

test("what the gate would refuse is said before it is sent", () => {
  assert.equal(faultOf(square, [5, 5]), "");
  assert.equal(faultOf([], [5, 5]), "");
  assert.equal(faultOf(square.slice(0, 2), null), "few");
  assert.equal(faultOf([[0, 0], [10, 10], [10, 0], [0, 10]], null), "crossed");
  assert.equal(faultOf(square, [15, 5]), "outside");
  assert.equal(faultOf(Array.from({ length: 33 }, (_, i): Corner =>
    [20 * Math.cos(i / 5.3), 20 * Math.sin(i / 5.3)]), null), "many");
  assert.equal(contains(square, [5, 5]), true);
});

test("bounds and return place are what the gate says, and unknown where an older one does not", () => {
  const told = safety(1, { fence_m: [0, 0, 10, 0, 10, 10], altitude_min_m: NaN, altitude_max_m: 8,
    home_known: true, home_m: [3, 4, 1] }) as SafetyState;
  assert.deepEqual(boundsOf(told), { fence_m: [[0, 0], [10, 0], [10, 10]], altitude_min_m: null,
    altitude_max_m: 8 });
  assert.deepEqual(homeOf(told), [3, 4, 1]);
  assert.equal(homeOf({ ...told, home_known: false }), null);
  const { fence_m, ...older } = told;
  assert.equal(boundsOf(older), null);
  assert.equal(boundsOf(undefined), null);
});

test("zooming keeps the middle, and the ruler has a round length that is seen", () => {
  const map = mapAround([[0, 0], [40, 10]], 400, 300);
  const middle = toMetres(map, [200, 150]);
  for (const zoom of [0.2, 1, 7]) {
    const closer = zoomed(map, zoom, 400, 300);
    const kept = toMetres(closer, [200, 150]);
    assert.ok(Math.hypot(kept[0] - middle[0], kept[1] - middle[1]) < 1e-9);
    assert.ok(Math.abs(closer.scale - zoom * map.scale) < 1e-12);
    const { metres, px } = scaleOf(closer);
    assert.ok(px > 40 && px <= 101 && Math.abs(px - metres * closer.scale) < 1e-9, `${px}`);
  }
});

test("an order that was refused is a warning, whatever the reason", () => {
  for (const [command_result, severity] of [[1, "info"], [11, "info"], [9, "warning"],
    [12, "warning"], [13, "warning"]] as const) {
    const state = fold([sample("/uav1/safety/state", 1, safety(1)),
      sample("/uav1/safety/state", 2, safety(2, { command_id: 7n, command: 10, command_result }))]);
    assert.equal(state.events.at(-1)!.severity, severity, `${command_result}`);
  }
});

test("a framing says what it is, and presets are within what the gate takes", () => {
  assert.equal(framingText(framingOf({ distance_m: NaN, height_m: NaN, bearing_rad: NaN,
    circling_radps: 0 })), "as the parameters say");
  assert.equal(framingText({ distance_m: 2, height_m: null, bearing_rad: -3.1, circling_radps: 0 }),
    "2.0 m, behind");
  assert.equal(sideOf(-1.5), "right");
  assert.ok(same({ ...free, bearing_rad: Math.PI }, { ...free, bearing_rad: -Math.PI }));
  const within = (value: number | null, [low, high]: readonly [number, number]) =>
    value === null || (value >= low && value <= high);
  for (const [name, { distance_m, height_m, circling_radps }] of presets)
    assert.ok(within(distance_m, limits.distance_m) && within(height_m, limits.height_m) &&
      within(circling_radps, limits.circling_radps), name);
});

function ready() {
  const inputs = [];
  for (let step = 0; step <= 400; step++)
    for (const [name, message] of samplesAt(step / 100, step, 0))
      inputs.push(sample(`/uav1/${name}`, step / 100, message));
  const state = fold(inputs);
  reduce(state, { kind: "link", open: true, reason: "", now_s: 4 });
  return { state, vehicle: state.vehicles.get("uav1")! };
}

test("the checklist is green where all is well, and red with what to do where it is not", () => {
  const { state, vehicle } = ready();
  const well = checklist(state, state, vehicle);
  assert.ok(isReady(well), JSON.stringify(well.filter((c) => c.light === "red")));
  const reds = (): string[] => checklist(state, state, vehicle).filter((c) => c.light === "red")
    .map((c) => c.what);
  fold([sample("/uav1/safety/state", 4.01, safety(4, { mode: 4,
    text: "PX4 would refuse: no GPS lock" }))], state);
  assert.deepEqual(reds(), ["the autopilot would refuse: no GPS lock"]);
  fold([sample("/uav1/safety/state", 4.02, safety(4))], state);
  assert.deepEqual(reds(), []);
  reduce(state, { kind: "time", now_s: 30 });
  assert.ok(reds().includes("nothing is heard of the vehicle"));
});

test("what the gate does when something fails is what its own diagnostic tells", () => {
  const { state, vehicle } = ready();
  const of = () => new Map(reactions(state, vehicle)).get("the battery is at its reserve");
  assert.equal(of(), "as its parameter battery_reaction says");
  const message = diagnosticsOf(4, "uav1", [1, 2]);
  message.status[0]!.values.push({ key: "link_reaction", value: "1" },
    { key: "battery_reaction", value: "2" },
    { key: "framing_distance_max_m", value: "6" });
  fold([{ kind: "sample", sample: { topic: "/diagnostics", vehicle: "", name: "diagnostics",
    type: "T", time_s: 4, bytes: 1, message } }], state);
  assert.equal(of(), "it returns");
  assert.deepEqual(limitsOf(state, vehicle).distance_m, [1.5, 6]);
});
