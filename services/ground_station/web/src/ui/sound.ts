// SPDX-License-Identifier: Apache-2.0
// Alarms that nobody acknowledged are heard: two tones at once, and again every few seconds.
import type { State } from "../store/state.ts";

const again_s = 4;
const key = "foretrack.muted";

export class AlarmSound {
  muted = localStorage.getItem(key) === "yes";
  played = 0; // how often
  private context: AudioContext | null = null;
  private played_ms = -Infinity;
  private known = new Set<string>();

  constructor() {
    // Browsers play nothing before the page was touched.
    const touch = (): void => {
      this.context ??= new AudioContext();
      void this.context.resume();
    };
    window.addEventListener("pointerdown", touch, { once: true });
    window.addEventListener("keydown", touch, { once: true });
  }

  toggle(): void {
    this.muted = !this.muted;
    localStorage.setItem(key, this.muted ? "yes" : "no");
  }

  /** Once a frame, or twice a second while the page is hidden. */
  hear(state: State, now_ms = performance.now()): void {
    const open = [...state.alarms.values()].filter((alarm) =>
      alarm.severity === "alarm" && !alarm.acknowledged && alarm.cleared_s === null);
    const isNew = open.some((alarm) => !this.known.has(alarm.key));
    this.known = new Set(open.map((alarm) => alarm.key));
    if (open.length === 0 || this.muted) return;
    if (!isNew && now_ms - this.played_ms < 1000 * again_s) return;
    this.played_ms = now_ms;
    this.play();
  }

  private play(): void {
    this.played++;
    const { context } = this;
    if (!context || context.state !== "running") return;
    for (const [i, hertz] of [880, 660].entries()) {
      const tone = context.createOscillator();
      const loudness = context.createGain();
      const begin_s = context.currentTime + 0.22 * i;
      tone.frequency.value = hertz;
      loudness.gain.setValueAtTime(0.12, begin_s);
      loudness.gain.exponentialRampToValueAtTime(0.001, begin_s + 0.2);
      tone.connect(loudness).connect(context.destination);
      tone.start(begin_s);
      tone.stop(begin_s + 0.2);
    }
  }
}
