/**
 * Plays a recording as the server would send it. Forwards it gives every frame; for a jump only those that the moment
 * is made of, the pictures since the last whole one.
 */
import { FrameType, HEADER_BYTES, parseHeader } from '../wire/frame';
import { isWhole } from '../wire/picture';
import type { Recording, TimedFrame } from './recording';

/** Where time comes from: the browser, or a test. */
export interface Clock {
  now_ms(): number;
  /** Gives back what ends it. */
  every(pause_ms: number, tick: () => void): () => void;
}

const browserClock: Clock = {
  now_ms: () => performance.now(),
  every: (pause_ms, tick) => {
    const timer = setInterval(tick, pause_ms);
    return () => clearInterval(timer);
  },
};

const TICK_MS = 16;

export class Player {
  readonly length_s: number;
  private readonly frames: readonly TimedFrame[];
  private take: (frame: Uint8Array) => void = () => {};
  private next = 0; // frame that was not given yet
  private at_ms = 0;
  private ticked_ms = 0;
  private stop: (() => void) | null = null;
  private readonly listeners = new Set<() => void>();

  constructor(
    recording: Recording,
    private readonly clock: Clock = browserClock,
  ) {
    this.frames = recording.frames;
    this.length_s = (this.frames.at(-1)?.at_ms ?? 0) / 1000;
  }

  get time_s(): number {
    return this.at_ms / 1000;
  }

  get playing(): boolean {
    return this.stop !== null;
  }

  /** Gives frames, header and all, from now on. */
  start(take: (frame: Uint8Array) => void): void {
    this.take = take;
    this.giveUntil(0);
    this.play();
  }

  /** From the beginning where it had come to the end. */
  play(): void {
    if (this.playing || this.length_s === 0) return;
    if (this.time_s >= this.length_s) this.seek(0);
    this.ticked_ms = this.clock.now_ms();
    this.stop = this.clock.every(TICK_MS, () => this.tick());
    this.tell();
  }

  pause(): void {
    this.stop?.();
    this.stop = null;
    this.tell();
  }

  seek(time_s: number): void {
    const wanted_ms = 1000 * Math.min(this.length_s, Math.max(0, time_s));
    const end = this.frames.findIndex((frame) => frame.at_ms > wanted_ms);
    const until = end < 0 ? this.frames.length : end;
    for (const index of this.momentBefore(until)) this.give(index);
    this.next = until;
    this.at_ms = wanted_ms;
    this.tell();
  }

  /** Called whenever time or state change; gives back what ends that. */
  onChange(listener: () => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private tick(): void {
    const now_ms = this.clock.now_ms();
    this.giveUntil(Math.min(1000 * this.length_s, this.at_ms + now_ms - this.ticked_ms));
    this.ticked_ms = now_ms;
    if (this.next === this.frames.length) this.pause();
    else this.tell();
  }

  private giveUntil(time_ms: number): void {
    while ((this.frames[this.next]?.at_ms ?? Infinity) <= time_ms) this.give(this.next++);
    this.at_ms = time_ms;
  }

  private give(index: number): void {
    const frame = this.frames[index];
    if (frame) this.take(frame.bytes);
  }

  private tell(): void {
    for (const listener of [...this.listeners]) listener();
  }

  /** The frames before `until` that make its moment, in their order. */
  private momentBefore(until: number): number[] {
    let pictures: number[] = [];
    this.frames.slice(0, until).forEach(({ bytes }, index) => {
      if (parseHeader(bytes).type !== FrameType.Picture) return;
      if (isWhole(bytes.subarray(HEADER_BYTES))) pictures = [];
      pictures.push(index);
    });
    return pictures;
  }
}
