// SPDX-License-Identifier: Apache-2.0
// When the scene is drawn and how fine: thirty times a second where the machine can, coarser where
// it cannot, and seldom where even that is too much.

const period_ms = 1000 / 30;
const slowPeriod_ms = 1000 / 12;
const slack_ms = 4; // the display's frames do not fit ours
const coarsest = 0.5;
const patience_s = 4;
const longestPatience_s = 60;
// Of a second: fewer frames are too few, or so few that only a slower pace helps.
const [enough, veryFew, enoughSlow] = [29, 10, 11];
// Of a picture until it is drawn: what leaves time for the rest of the page, what does only while
// no frame is missing, and what is too long for the pace.
const [good_ms, fair_ms, most_ms] = [26, 20, 30];
const step = 1.3; // less gains nothing: what is coarse must be drawn out to the page's pixels

export class Pace {
  /** Pixels drawn for one of the page's. */
  ratio: number;
  private period_ms = period_ms;
  private due_ms = 0;
  private calm_s = 0; // for which all went well
  private patience_s = patience_s; // before finer pictures are tried
  private sinceFiner_s = Infinity;
  private starting_s = 3; // what is loaded then says nothing of the pictures to come

  constructor(private readonly finest: number) {
    this.ratio = finest;
  }

  /** Thirty a second on the average; a frame that came late is not made up for. */
  isDue(now_ms: number): boolean {
    if (now_ms < this.due_ms - slack_ms) return false;
    const isLate = now_ms - this.due_ms > this.period_ms;
    this.due_ms = (isLate ? now_ms : this.due_ms) + this.period_ms;
    return true;
  }

  /** After each second in which all frames were wanted; busy_ms: of a picture until it is drawn. */
  adapt(fps: number, busy_ms: number): void {
    if (this.starting_s-- > 0) return;
    this.sinceFiner_s++;
    const isSlow = this.period_ms === slowPeriod_ms;
    const isLate = fps < (isSlow ? enoughSlow : enough);
    if (!isSlow && (busy_ms > most_ms || (isLate && busy_ms > fair_ms)))
      return this.yield(fps, busy_ms);
    const hasTime = this.ratio < this.finest && busy_ms * step < good_ms;
    this.calm_s = !isLate && (isSlow || hasTime) ? this.calm_s + 1 : 0;
    if (this.calm_s < this.patience_s) return;
    this.calm_s = 0;
    if (isSlow) this.period_ms = period_ms; // perhaps it can now
    else this.refine();
  }

  // At once as far as it takes. What was tried in vain is tried again later.
  private yield(fps: number, busy_ms: number): void {
    if (this.sinceFiner_s < patience_s)
      this.patience_s = Math.min(longestPatience_s, 2 * this.patience_s);
    this.sinceFiner_s = Infinity;
    this.calm_s = 0;
    if (fps < veryFew && this.ratio <= coarsest) this.period_ms = slowPeriod_ms;
    const share = Math.min(1 / step, Math.max(0.7, Math.sqrt(good_ms / busy_ms)));
    this.ratio = Math.max(coarsest, share * this.ratio);
  }

  private refine(): void {
    this.ratio = Math.min(this.finest, step * this.ratio);
    this.sinceFiner_s = 0;
  }
}
