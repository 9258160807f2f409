// SPDX-License-Identifier: Apache-2.0
// What was drawn in about a second, and how long it took.

export interface Second {
  fps: number;
  script_ms: number; // of a frame, ours alone
  busy_ms: number; // of a frame until it was drawn
}

export class Tally {
  wantedAll = true; // no frame was left out as nothing had changed
  private frames = 0;
  private script_ms = 0;
  private busy_ms = 0;
  private begin_ms = performance.now();
  private frame_ms = 0; // when it began
  private readonly after = new MessageChannel();

  constructor() {
    this.after.port1.onmessage = () => (this.busy_ms += performance.now() - this.frame_ms);
  }

  /** After the script of a frame. The picture is drawn before the next message is heard. */
  frame(begin_ms: number): void {
    this.frames++;
    this.frame_ms = begin_ms;
    this.script_ms += performance.now() - begin_ms;
    this.after.port2.postMessage(null);
  }

  /** Once a second; else null. */
  take(now_ms: number): Second | null {
    const elapsed_ms = now_ms - this.begin_ms;
    if (elapsed_ms < 1000) return null;
    const { frames } = this;
    const each = (sum_ms: number): number => sum_ms / Math.max(1, frames);
    const second = { fps: (1000 * frames) / elapsed_ms, script_ms: each(this.script_ms),
      busy_ms: each(this.busy_ms) };
    this.frames = this.script_ms = this.busy_ms = 0;
    this.begin_ms = now_ms;
    return second;
  }
}
