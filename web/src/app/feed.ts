/** Frames in, what they say out: the same for a live class and for a recording. */
import { WireError } from '../wire/cursor';
import { FrameType, frameBytes, parseFrame, type Frame } from '../wire/frame';
import { decodeMesh, type Mesh } from '../wire/mesh';
import type { Picture } from '../wire/moment';
import { PictureDecoder } from '../wire/picture';
import { decodeEvent, decodeForce, decodeWelcome, type Event, type Force, type Welcome } from '../wire/small';

export interface FeedListener {
  welcome(welcome: Welcome): void;
  mesh(mesh: Mesh): void;
  picture(picture: Picture): void;
  force(force: Force): void;
  event(event: Event): void;
  control(message: Record<string, unknown>): void;
}

const utf8 = new TextDecoder();

export class Feed {
  private pictures = new PictureDecoder();

  constructor(private readonly listener: FeedListener) {}

  /** Header and all. Throws a WireError. */
  takeRaw(raw: Uint8Array): void {
    this.take(parseFrame(raw));
  }

  take({ type, payload }: Frame): void {
    if (type === FrameType.Welcome) this.begin(decodeWelcome(payload));
    else if (type === FrameType.Mesh) this.listener.mesh(decodeMesh(payload));
    else if (type === FrameType.Picture) this.listener.picture(this.pictures.take(payload));
    else if (type === FrameType.Force) this.listener.force(decodeForce(payload));
    else if (type === FrameType.Event) this.listener.event(decodeEvent(payload));
    else if (type === FrameType.Control) this.listener.control(parseControl(payload));
  }

  /** The newest picture as a frame that needs none before it; null before the first. */
  wholePicture(): Uint8Array | null {
    const payload = this.pictures.whole();
    return payload && frameBytes({ type: FrameType.Picture, flags: 0, sequence: 0, time_ns: 0, payload });
  }

  /** A connection's pictures refer to nothing of the one before. */
  private begin(welcome: Welcome): void {
    this.pictures = new PictureDecoder();
    this.listener.welcome(welcome);
  }
}

function parseControl(payload: Uint8Array): Record<string, unknown> {
  try {
    const message: unknown = JSON.parse(utf8.decode(payload));
    if (typeof message === 'object' && message !== null) return message as Record<string, unknown>;
  } catch {
    // answered below, as any other message that is none
  }
  throw new WireError('a control that is no JSON object');
}
