// SPDX-License-Identifier: Apache-2.0
import assert from "node:assert/strict";
import { test } from "node:test";

import { spanOf } from "../../src/ui/clip.ts";

const live = (recording: { active: boolean; file: string; seconds: number } | null) =>
  ({ replay: null, liveState: { station: { message: { recording } } } });

test("a clip is the last seconds of what is recorded or replayed, from the recording's beginning", () => {
  assert.equal(spanOf(live(null)), null);
  assert.equal(spanOf(live({ active: false, file: "a.mcap", seconds: 9 })), null);
  assert.deepEqual(spanOf(live({ active: true, file: "a.mcap", seconds: 9 })),
    { file: "a.mcap", from_s: 0, to_s: 9 });
  const replay = { recording: { name: "b.mcap", begin_s: 1000 }, time_s: () => 1065 };
  assert.deepEqual(spanOf({ ...live(null), replay }), { file: "b.mcap", from_s: 45, to_s: 65 });
});
