// When the scene is drawn and how fine: thirty times a second where the machine can, coarser where
// it cannot, and seldom where even that is too much.

const period_ms = 1000 / 30;
const slowPeriod_ms = 1000 / 12;
const slack_ms = 4; // the display's frames do not fit ours
const coarsest = 0.5;
const [fewest, enough, veryFew] = [20, 24, 10]; // frames a second
const patience_s = 4;
const longestPatience_s = 60;

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

  /** After each second in which all frames were wanted. */
  adapt(fps: number): void {
    if (this.starting_s-- > 0) return;
    this.sinceFiner_s++;
    if (fps < fewest && this.period_ms === period_ms) return this.yield(fps);
    const well = fps > (this.period_ms === period_ms ? enough : 11);
    this.calm_s = well ? this.calm_s + 1 : 0;
    if (this.calm_s < this.patience_s) return;
    this.calm_s = 0;
    if (this.period_ms === slowPeriod_ms) this.period_ms = period_ms; // perhaps it can now
    else if (this.ratio < this.finest) this.refine();
  }

  // What was tried in vain is tried again later.
  private yield(fps: number): void {
    if (this.sinceFiner_s < patience_s)
      this.patience_s = Math.min(longestPatience_s, 2 * this.patience_s);
    this.sinceFiner_s = Infinity;
    this.calm_s = 0;
    if (fps < veryFew && this.ratio <= coarsest) this.period_ms = slowPeriod_ms;
    this.ratio = Math.max(coarsest, 0.8 * this.ratio);
  }

  private refine(): void {
    this.ratio = Math.min(this.finest, 1.25 * this.ratio);
    this.sinceFiner_s = 0;
  }
}
