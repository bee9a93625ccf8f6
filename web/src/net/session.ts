/**
 * One membership in a class over a WebSocket. It connects again by itself after a break, with the resume id that keeps
 * its hand where it has one, until the server or the page says that it is for good.
 *
 *   connecting --Welcome--> joined --break--> waiting (about 0.5 .. 5 s) --> connecting ...
 *        any of these --Bye for good, end()--> ended
 */
import type { Connection, Role } from '../app/state';
import { WireError } from '../wire/cursor';
import { FrameType, frameBytes } from '../wire/frame';
import { decodeBye, decodeWelcome, encodeBye, encodeHello, encodePing, PROTOCOL_VERSION, Want } from '../wire/small';
import type { Bye, Welcome } from '../wire/small';
import { FrameStream, type ReceivedFrame } from './frame_stream';

const PING_EVERY_MS = 100;
/** The server pings back ten times a second: so long a silence is a dead link that TCP has not noticed yet. */
const SILENCE_MS = 4000;
const FIRST_WAIT_MS = 500;
const LONGEST_WAIT_MS = 5000;

export interface SessionOptions {
  url: string;
  token: Uint8Array;
  role: Role;
  name: string;
  /** Of a page that had a hand and was loaded again; 0n: a new member. */
  resume_id: bigint;
  onWelcome(welcome: Welcome): void;
  onFrame(frame: ReceivedFrame): void;
  onConnection(connection: Connection): void;
}

export class Session {
  private socket: WebSocket | null = null;
  private stream = new FrameStream();
  private sent = 0;
  private joined = false;
  private ended = false;
  private resume_id: bigint;
  private wait_ms = FIRST_WAIT_MS;
  private reason = 'web.net.broken';
  private pinged_ms = 0;
  private heard_ms = 0;
  private retryTimer: ReturnType<typeof setTimeout> | undefined;
  private readonly pingTimer: ReturnType<typeof setInterval>;

  constructor(private readonly options: SessionOptions) {
    this.resume_id = options.resume_id;
    this.pingTimer = setInterval(() => this.tick(), PING_EVERY_MS);
    this.connect();
  }

  /** Drops what cannot be sent now: the next connection begins anew. */
  send(type: number, payload: Uint8Array, flags = 0): void {
    if (this.joined) this.write(type, payload, flags);
  }

  sendControl(control: object): void {
    this.send(FrameType.Control, new TextEncoder().encode(JSON.stringify(control)));
  }

  /** Says good-bye on the way out of the page; one that the browser keeps and shows again connects again. */
  leave(): void {
    this.send(FrameType.Bye, encodeBye({ reason: 'leaving', text: '' }));
    this.lost();
  }

  /** Closes for good; `key` of the sentence that says why. */
  end(key: string): void {
    if (this.ended) return;
    this.ended = true;
    clearInterval(this.pingTimer);
    this.lost();
    this.options.onConnection({ state: 'ended', key });
  }

  private connect(): void {
    this.stream = new FrameStream();
    this.sent = 0;
    const socket = new WebSocket(this.options.url);
    socket.binaryType = 'arraybuffer';
    this.socket = socket;
    this.heard_ms = performance.now();
    socket.addEventListener('open', () => {
      if (socket === this.socket) this.hello();
    });
    socket.addEventListener('message', (message) => {
      if (socket === this.socket) this.take(new Uint8Array(message.data as ArrayBuffer));
    });
    socket.addEventListener('close', () => {
      if (socket === this.socket) this.lost();
    });
  }

  private hello(): void {
    const { role, token, name } = this.options;
    const hand = role === 'viewer' ? 0 : Want.Hand;
    const wants = hand | Want.Meshes | Want.Pictures | Want.Class;
    const hello = { version: PROTOCOL_VERSION, role, wants, hand: 'any' as const, token, name };
    this.write(FrameType.Hello, encodeHello({ ...hello, resume_id: this.resume_id }));
  }

  private take(bytes: Uint8Array): void {
    this.heard_ms = performance.now();
    try {
      for (const frame of this.stream.push(bytes)) this.obey(frame);
    } catch (error) {
      if (!(error instanceof WireError)) throw error;
      console.warn(`the server's frames: ${error.message}`);
      this.lost();
    }
    this.ping();
  }

  private obey(frame: ReceivedFrame): void {
    if (frame.type === FrameType.Welcome) this.welcome(decodeWelcome(frame.payload));
    if (frame.type === FrameType.Bye) this.bye(decodeBye(frame.payload));
    else this.options.onFrame(frame);
    // Only now does the link carry what it is for: one that breaks before gets longer and longer pauses.
    if (frame.type === FrameType.Picture) this.wait_ms = FIRST_WAIT_MS;
  }

  private welcome(welcome: Welcome): void {
    this.resume_id = idToResume(welcome);
    this.joined = true;
    this.reason = 'web.net.broken';
    this.options.onWelcome(welcome);
    this.options.onConnection({ state: 'joined' });
  }

  private bye(bye: Bye): void {
    if (bye.reason === 'token') this.end('web.net.token');
    else if (bye.reason === 'version') this.end('web.net.version');
    else {
      if (bye.reason === 'no hand') this.resume_id = 0n; // what it asked for is gone: it joins anew, to watch
      this.reason = byeSentences[bye.reason] ?? 'web.net.broken';
      this.lost();
    }
  }

  private lost(): void {
    this.joined = false;
    clearTimeout(this.retryTimer);
    const socket = this.socket;
    this.socket = null;
    socket?.close();
    if (this.ended) return;
    this.options.onConnection({ state: 'broken', key: this.reason });
    // Not all of a class at the same moment.
    this.retryTimer = setTimeout(() => this.connect(), (0.5 + Math.random()) * this.wait_ms);
    this.wait_ms = Math.min(2 * this.wait_ms, LONGEST_WAIT_MS);
  }

  private tick(): void {
    if (this.socket !== null && performance.now() - this.heard_ms > SILENCE_MS) this.lost();
    this.ping();
  }

  /** By the timer, and by what comes: browsers slow down the timers of a page that is not seen. */
  private ping(): void {
    const now_ms = performance.now();
    if (!this.joined || now_ms - this.pinged_ms < 0.9 * PING_EVERY_MS) return;
    this.pinged_ms = now_ms;
    this.write(FrameType.Ping, encodePing(clock_ns()));
  }

  private write(type: number, payload: Uint8Array, flags = 0): void {
    if (this.socket?.readyState !== WebSocket.OPEN) return;
    this.socket.send(frameBytes({ type, flags, sequence: this.sent++, time_ns: clock_ns(), payload }));
  }
}

const byeSentences: Partial<Record<Bye['reason'], string>> = {
  full: 'web.net.full',
  silent: 'web.net.silent',
  'no hand': 'web.net.no_hand',
  closing: 'web.net.closing',
};

/** Of a member that watches there is nothing to keep; its id would only ask for a hand. */
export function idToResume({ hand, resume_id }: Welcome): bigint {
  return hand >= 0 ? resume_id : 0n;
}

function clock_ns(): number {
  return Math.round(performance.now() * 1e6);
}
