/** Keeps the frames of the last start until it is stopped, or full. */

import { FrameType, parseHeader } from '../wire/frame';
import { keptFrame } from './keep_frame';
import type { TimedFrame } from './recording';

export const LONGEST_S = 60;
export const MOST_BYTES = 30e6;
/** So often a picture is kept that needs none before it: a jump in the recording decodes no more than is between. */
const WHOLE_EVERY_MS = 2000;

export class Recorder {
  private kept: TimedFrame[] = [];
  private began_ms = 0;
  private bytes_ = 0;
  private newest_ms = 0;
  private whole_ms = 0; // when a whole picture was kept last
  private recording_ = false;

  get recording(): boolean {
    return this.recording_;
  }

  get bytes(): number {
    return this.bytes_;
  }

  get length_s(): number {
    return (this.newest_ms - this.began_ms) / 1000;
  }

  get frames(): readonly TimedFrame[] {
    return this.kept;
  }

  /** Begins anew with the frames that somebody who starts to look at `now_ms` needs. */
  start(priming: readonly Uint8Array[], now_ms: number): void {
    this.kept = [];
    this.bytes_ = 0;
    this.began_ms = this.newest_ms = this.whole_ms = now_ms;
    this.recording_ = true;
    for (const frame of priming) this.keep(frame, now_ms);
  }

  /** `whole`: the picture before this frame, whole. False where it ended with this frame, since it is full. */
  take(frame: Uint8Array, at_ms: number, whole: () => Uint8Array | null): boolean {
    if (!this.recording_) return false;
    if (parseHeader(frame).type === FrameType.Picture && at_ms - this.whole_ms > WHOLE_EVERY_MS) {
      this.whole_ms = at_ms;
      this.keep(whole(), this.newest_ms);
    }
    const full = at_ms - this.began_ms > 1000 * LONGEST_S || this.bytes_ + frame.length > MOST_BYTES;
    if (full) this.recording_ = false;
    else this.keep(frame, at_ms);
    return !full;
  }

  stop(): void {
    this.recording_ = false;
  }

  private keep(frame: Uint8Array | null, at_ms: number): void {
    const bytes = frame && keptFrame(frame);
    if (!bytes) return;
    this.kept.push({ at_ms: at_ms - this.began_ms, bytes: bytes.slice() }); // the socket may use its buffer again
    this.bytes_ += bytes.length;
    this.newest_ms = at_ms;
  }
}
