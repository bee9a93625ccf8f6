/** A stream of bytes, in pieces of any size, cut into the frames of one direction of a connection. */
import { WireError } from '../wire/cursor';
import { HEADER_BYTES, parseFrame, parseHeader, type Frame } from '../wire/frame';

export interface ReceivedFrame extends Frame {
  /** Header and all. */
  raw: Uint8Array;
}

export class FrameStream {
  private pending: Uint8Array = new Uint8Array(0);
  private due = 0;

  /** The frames that are whole with this piece. Throws a WireError for what breaks a rule; nothing counts after that. */
  push(piece: Uint8Array): ReceivedFrame[] {
    this.append(piece);
    const frames: ReceivedFrame[] = [];
    while (this.pending.length >= HEADER_BYTES) {
      const size = HEADER_BYTES + parseHeader(this.pending).length;
      if (this.pending.length < size) break;
      frames.push(this.check(this.pending.subarray(0, size)));
      this.pending = this.pending.subarray(size);
    }
    return frames;
  }

  private append(piece: Uint8Array): void {
    if (this.pending.length === 0) {
      this.pending = piece;
      return;
    }
    const joined = new Uint8Array(this.pending.length + piece.length);
    joined.set(this.pending);
    joined.set(piece, this.pending.length);
    this.pending = joined;
  }

  private check(raw: Uint8Array): ReceivedFrame {
    const frame = { ...parseFrame(raw), raw };
    if (frame.sequence !== this.due) throw new WireError(`frame ${frame.sequence} where ${this.due} was due`);
    ++this.due;
    return frame;
  }
}
