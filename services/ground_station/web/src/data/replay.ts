// SPDX-License-Identifier: Apache-2.0
// The replay source: reads ahead of its clock, and hands over what the clock has passed.
import * as clocks from "./clock.ts";
import type { Recording } from "./recording.ts";
import type { RawSample } from "./sample.ts";

const ahead_s = 4; // read ahead, times the speed
const history_s = 60; // before a place that is sought, so that plots and trails are full
const wall_s = (): number => performance.now() / 1000;

export interface ReplayBatch {
  restart: boolean; // forget all state: these samples begin anew
  now_s: number;
  samples: RawSample[];
}

export class Replay {
  clock: clocks.ReplayClock;
  problem = "";
  private ready: RawSample[] = []; // read, not yet passed
  private taken = 0; // of ready
  private readTo_s: number;
  private reading = false;
  private restart = false;
  private generation = 0; // of seeks

  constructor(readonly recording: Recording) {
    this.clock = clocks.makeClock(recording.begin_s, recording.end_s);
    this.readTo_s = recording.begin_s;
    this.seek(recording.begin_s);
  }

  time_s(): number {
    return clocks.timeAt(this.clock, wall_s());
  }
  isLoading(): boolean {
    return this.reading && this.readTo_s < this.time_s();
  }
  play(playing: boolean): void {
    this.clock = clocks.play(this.clock, playing, wall_s());
    if (playing && this.clock.anchor_s === this.clock.begin_s) this.seek(this.clock.begin_s);
  }
  setSpeed(speed: number): void {
    this.clock = clocks.setSpeed(this.clock, speed, wall_s());
  }
  step(by_s: number): void {
    const to_s = this.time_s() + by_s;
    this.clock = clocks.step(this.clock, by_s, wall_s());
    if (by_s < 0) this.seek(to_s);
  }

  seek(to_s: number): void {
    this.clock = clocks.seek(this.clock, to_s, wall_s());
    this.generation++;
    this.restart = true;
    this.ready = [];
    this.taken = 0;
    this.readTo_s = -Infinity;
  }

  /** What became due since the last call; starts reading what will be due next. */
  take(): ReplayBatch {
    if (clocks.hasEnded(this.clock, wall_s())) this.play(false);
    void this.readAhead();
    const now_s = this.time_s();
    if (this.restart && this.readTo_s === -Infinity) return { restart: false, now_s, samples: [] };
    const restart = this.restart;
    this.restart = false;
    const from = this.taken;
    while (this.taken < this.ready.length && this.ready[this.taken]!.time_s <= now_s) this.taken++;
    return { restart, now_s, samples: this.ready.slice(from, this.taken) };
  }

  private async readAhead(): Promise<void> {
    const now_s = this.time_s();
    const want_s = Math.min(now_s + ahead_s * Math.max(1, this.clock.speed), this.recording.end_s);
    if (this.reading || this.readTo_s >= this.nearEnd(want_s)) return;
    this.reading = true;
    const { generation } = this;
    const cancelled = (): boolean => generation !== this.generation;
    try {
      const fresh = this.readTo_s === -Infinity;
      const from_s = fresh ? now_s - history_s : this.readTo_s;
      const before = fresh ? await this.recording.lastBefore(from_s) : [];
      const read = await this.recording.read(from_s, want_s, cancelled);
      if (cancelled()) return;
      this.ready = [...this.ready.slice(this.taken), ...before, ...read];
      this.taken = 0;
      this.readTo_s = want_s;
    } catch (error) {
      this.problem = `${this.recording.name}: ${(error as Error).message}`;
      this.clock = clocks.play(this.clock, false, wall_s());
      this.readTo_s = want_s;
    } finally {
      this.reading = false;
    }
  }

  // Up to the very end there may be less than a second to read.
  private nearEnd(want_s: number): number {
    return want_s === this.recording.end_s ? want_s : want_s - 1;
  }
}
