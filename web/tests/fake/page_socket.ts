/** The page's end of a WebSocket without a network, for tests of what a page says and when. */
import { FrameStream, type ReceivedFrame } from '../../src/net/frame_stream';
import { FrameType, frameBytes } from '../../src/wire/frame';
import { encodeBye, encodeWelcome, type Bye } from '../../src/wire/small';

export class PageSocket extends EventTarget {
  static readonly OPEN = 1;
  /** Every one that was made, in turn. */
  static made: PageSocket[] = [];
  readyState = 0;
  binaryType = '';
  /** What the page sent. */
  readonly heard: ReceivedFrame[] = [];
  private readonly stream = new FrameStream();
  private sent = 0;

  constructor(readonly url: string) {
    super();
    PageSocket.made.push(this);
  }

  send(bytes: Uint8Array): void {
    this.heard.push(...this.stream.push(bytes));
  }

  close(): void {
    if (this.readyState === 3) return;
    this.readyState = 3;
    this.dispatchEvent(new Event('close'));
  }

  open(): void {
    this.readyState = PageSocket.OPEN;
    this.dispatchEvent(new Event('open'));
  }

  /** As from the server. */
  give(type: number, payload: Uint8Array = new Uint8Array(0)): void {
    const bytes = frameBytes({ type, flags: 0, sequence: this.sent++, time_ns: 0, payload });
    this.dispatchEvent(Object.assign(new Event('message'), { data: bytes.buffer }));
  }

  welcome(hand: number, resume_id: bigint): void {
    const rest = { client: 1, role: 'student' as const, lockstep: false, step_ns: 1e7, server_time_ns: 0 };
    this.give(FrameType.Welcome, encodeWelcome({ hand, resume_id, ...rest }));
  }

  bye(reason: Bye['reason']): void {
    this.give(FrameType.Bye, encodeBye({ reason, text: '' }));
  }
}
