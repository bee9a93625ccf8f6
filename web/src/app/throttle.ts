function byTimer(wake: () => void, pause_ms: number): () => void {
  const timer = setTimeout(wake, pause_ms);
  return () => clearTimeout(timer);
}

/** Lets the newest of many values through at most so often; the last one always comes through. */
export class Throttle<Value> {
  private waiting: { value: Value } | null = null;
  private cancel: (() => void) | null = null;

  constructor(
    private readonly pause_ms: number,
    private readonly pass: (value: Value) => void,
    private readonly later: (wake: () => void, pause_ms: number) => () => void = byTimer,
  ) {}

  push(value: Value): void {
    if (this.cancel) {
      this.waiting = { value };
      return;
    }
    this.pass(value);
    this.cancel = this.later(() => this.wake(), this.pause_ms);
  }

  /** Forgets what waits. */
  stop(): void {
    this.cancel?.();
    this.cancel = this.waiting = null;
  }

  private wake(): void {
    const { waiting } = this;
    this.cancel = this.waiting = null;
    if (waiting) this.push(waiting.value);
  }
}
