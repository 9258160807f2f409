// SPDX-License-Identifier: Apache-2.0
// The last few messages of a topic by their own stamps, to find the one of an image.

export class History<T> {
  private items: { stamp_s: number; value: T }[] = [];
  constructor(private readonly keep_s = 3, private readonly most = 160) {}

  /** Stamps that go back by more than a second begin anew. */
  push(stamp_s: number, value: T): void {
    const last_s = this.items[this.items.length - 1]?.stamp_s ?? -Infinity;
    if (stamp_s < last_s - 1) this.items = [];
    else if (stamp_s <= last_s) return;
    this.items.push({ stamp_s, value });
    const old = this.items.findIndex((item) => item.stamp_s >= stamp_s - this.keep_s);
    if (old > 32 || this.items.length > this.most) this.items.splice(0, Math.max(old, 32));
  }

  get newest(): { stamp_s: number; value: T } | undefined {
    return this.items[this.items.length - 1];
  }

  /** The last at or before that time, and the first after it. */
  around(stamp_s: number): { before?: { stamp_s: number; value: T };
                             after?: { stamp_s: number; value: T } } {
    const { items } = this;
    let i = items.length;
    while (i > 0 && items[i - 1]!.stamp_s > stamp_s) i--;
    return { ...(i > 0 && { before: items[i - 1]! }), ...(i < items.length && { after: items[i]! }) };
  }

  /** The one for which that time is nearest to what `of` says of it; undefined: there is none. */
  nearest(stamp_s: number, of: (value: T, stamp_s: number) => number): T | undefined {
    let [best, least_s]: [T | undefined, number] = [undefined, Infinity];
    for (const item of this.items) {
      const off_s = Math.abs(of(item.value, item.stamp_s) - stamp_s);
      if (off_s < least_s) [best, least_s] = [item.value, off_s];
    }
    return best;
  }
}
