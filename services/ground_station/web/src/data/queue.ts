// SPDX-License-Identifier: Apache-2.0
// Samples between two frames. Of topics whose newest sample says it all, older ones keep only their
// count, so that a slow or hidden page holds no heap of stale bytes.
import type { RawSample } from "./sample.ts";
import { readingOf } from "./topics.ts";

export class SampleQueue {
  private pending: RawSample[] = [];
  private readonly newest = new Map<string, RawSample>();

  push(raw: RawSample): void {
    const { topic } = raw.channel;
    if (readingOf(topic) !== "all") {
      const older = this.newest.get(topic);
      if (older) older.data = null;
      this.newest.set(topic, raw);
    }
    this.pending.push(raw);
  }

  take(): RawSample[] {
    const batch = this.pending;
    this.pending = [];
    this.newest.clear();
    return batch;
  }
}
