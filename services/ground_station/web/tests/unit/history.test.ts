// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { History } from "../../src/store/history.ts";

test("it keeps some seconds, and finds what lies around a time", () => {
  const history = new History<number>(1);
  for (let i = 0; i < 1000; i++) history.push(i / 100, i);
  assert.equal(history.newest!.value, 999);
  assert.equal(history.around(9.505).before!.value, 950);
  assert.equal(history.around(9.505).after!.value, 951);
  assert.equal(history.around(1).before, undefined);
  assert.equal(history.around(20).after, undefined);
  assert.equal(history.nearest(9.5, (value) => value / 100 + 0.2), 930);
});

test("what is older than the newest is left out, and a clock that was set back begins anew", () => {
  const history = new History<string>();
  history.push(10, "a");
  history.push(9.5, "late");
  assert.equal(history.newest!.value, "a");
  history.push(2, "anew");
  assert.equal(history.newest!.value, "anew");
  assert.equal(history.around(10).before!.value, "anew");
});
