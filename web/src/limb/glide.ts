/** Numbers on their way from where they are drawn to where the newest picture has them: no jump, whatever comes when. */
export class Glide {
  private from: Float32Array;
  private to: Float32Array;
  private moving = false;

  /** `least`: a goal that is nowhere farther from the one before is that one, so that what trembles stands still. */
  constructor(
    readonly drawn: Float32Array,
    private readonly least = 0,
  ) {
    this.from = drawn.slice();
    this.to = drawn.slice();
  }

  /** A new stretch of the way begins where it is drawn. */
  begin(): void {
    if (this.moving) this.from.set(this.drawn);
  }

  aim(goal: Float32Array): void {
    if (this.isNear(goal)) return;
    this.from.set(this.drawn);
    this.to.set(goal);
    this.moving = true;
  }

  jump(goal: Float32Array): void {
    this.from.set(goal);
    this.to.set(goal);
    this.drawn.set(goal);
    this.moving = true;
  }

  /** `share` of the way, 0 to 1; false: it stands still already. */
  step(share: number): boolean {
    if (!this.moving) return false;
    const { from, to, drawn } = this;
    for (let i = 0; i < drawn.length; ++i) drawn[i] = from[i]! + share * (to[i]! - from[i]!);
    this.moving = share < 1;
    return true;
  }

  private isNear(goal: Float32Array): boolean {
    for (let i = 0; i < goal.length; ++i) if (Math.abs(goal[i]! - this.to[i]!) > this.least) return false;
    return true;
  }
}

/** How long the way from one picture to the next takes, from when they come [ms]. */
export class Beat {
  private interval_ms = 33;
  private last_ms = -Infinity;

  come(now_ms: number): void {
    const since_ms = now_ms - this.last_ms;
    // A pause, and pictures that come in a heap after it, say nothing of the beat.
    if (since_ms > 5 && since_ms < 250) this.interval_ms += 0.1 * (since_ms - this.interval_ms);
    this.last_ms = now_ms;
  }

  share(now_ms: number): number {
    return Math.min(1, Math.max(0, (now_ms - this.last_ms) / this.interval_ms));
  }
}
