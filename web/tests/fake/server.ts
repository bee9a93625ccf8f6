/** A class without a simulation: serves the page and speaks the wire, for tests in a browser. */

import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { createServer, type IncomingMessage, type Server, type ServerResponse } from 'node:http';
import { extname, join } from 'node:path';
import type { Duplex } from 'node:stream';
import { FrameStream, type ReceivedFrame } from '../../src/net/frame_stream';
import { FrameType, frameBytes } from '../../src/wire/frame';
import { decodeHello, decodePing, encodeEvent, encodeForce, encodePong, encodeWelcome } from '../../src/wire/small';
import { decodeToolContact, decodeToolGrip, decodeToolState } from '../../src/wire/tool_state';
import { REPOSITORY } from '../elbow';
import { Classroom, NOT_INSTRUCTOR, type Pupil, type Refusal } from './classroom';
import { meshes, sceneFacts } from './limb';
import { accept, type Line } from './websocket';
import { HANDS, World } from './world';

const PICTURE_MS = 33;
const TYPES: Record<string, string> = {
  '.html': 'text/html',
  '.js': 'text/javascript',
  '.css': 'text/css',
  '.txt': 'text/plain',
};

const jsonBytes = (message: object) => new TextEncoder().encode(JSON.stringify(message));

/** One page's connection. */
class Seat {
  pupil: Pupil | null = null;
  private readonly stream = new FrameStream();
  private sent = 0;
  private contact: Uint8Array | null = null;
  private grip: Uint8Array | null = null;
  line: Line | null = null;

  constructor(private readonly fake: FakeServer) {}

  send(type: number, payload: Uint8Array): void {
    this.line?.send(frameBytes({ type, flags: 0, sequence: this.sent++, time_ns: 0, payload }));
  }

  take(message: Uint8Array): void {
    for (const frame of this.stream.push(new Uint8Array(message))) this.obey(frame);
  }

  private obey({ type, payload }: ReceivedFrame): void {
    if (type === FrameType.Hello) this.join(payload);
    else if (type === FrameType.Ping) {
      this.send(FrameType.Pong, encodePong({ ping_ns: decodePing(payload), arrived_ns: 0, left_ns: 0 }));
    } else if (type === FrameType.ToolContact) this.contact = payload;
    else if (type === FrameType.ToolGrip) this.grip = payload;
    else if (type === FrameType.ToolState) this.hold(payload);
    else if (type === FrameType.Control)
      this.control(JSON.parse(new TextDecoder().decode(payload)) as Record<string, unknown>);
  }

  private join(payload: Uint8Array): void {
    const { name, role, wants } = decodeHello(payload);
    const { id, hand } = this.fake.seat((wants & 1) !== 0);
    this.pupil = { id, name, role, hand };
    const rest = { lockstep: false, step_ns: 1e7, server_time_ns: 0 };
    this.send(FrameType.Welcome, encodeWelcome({ client: id, resume_id: BigInt(id), hand, role, ...rest }));
    this.send(FrameType.Control, jsonBytes({ scene: { name: 'elbow' } }));
    for (const mesh of meshes()) this.send(FrameType.Mesh, mesh);
    this.fake.announce();
  }

  private hold(payload: Uint8Array): void {
    const { state, third } = decodeToolState(payload);
    if (this.contact) state.contact = decodeToolContact(this.contact, third);
    if (this.grip) state.grip = decodeToolGrip(this.grip);
    this.contact = this.grip = null;
    const hand = this.pupil?.hand ?? -1;
    if (hand < 0) return;
    this.fake.world.hold(hand, state);
    const force_N = this.fake.world.force(hand);
    this.send(FrameType.Force, encodeForce({ tool_sequence: state.sequence, step: 0, force_N }));
  }

  private control(control: Record<string, unknown>): void {
    if (!this.pupil) return;
    const refused = this.fake.obey(this.pupil, control);
    if (refused !== null) this.send(FrameType.Event, encodeEvent({ code: 'refused', ...refused }));
  }
}

export class FakeServer {
  readonly world = new World();
  readonly classroom = new Classroom();
  /** Every Control, as it came. */
  readonly heard: Record<string, unknown>[] = [];
  private readonly seats = new Set<Seat>();
  private readonly server: Server;
  private readonly timer: ReturnType<typeof setInterval>;
  private members = 0;

  constructor(
    private readonly dist: string,
    private readonly lessons: readonly unknown[],
  ) {
    this.classroom.join = `http://192.0.2.7:7481/#token=${'0f'.repeat(16)}`;
    this.server = createServer((request, response) => this.answer(request, response));
    this.server.on('upgrade', (request: IncomingMessage, socket: Duplex) => this.open(request, socket));
    this.timer = setInterval(() => this.show(), PICTURE_MS);
  }

  listen(port = 0): Promise<string> {
    return new Promise((resolve) => {
      this.server.listen(port, '127.0.0.1', () => {
        const address = this.server.address();
        resolve(`http://127.0.0.1:${typeof address === 'object' && address ? address.port : port}/`);
      });
    });
  }

  close(): void {
    clearInterval(this.timer);
    for (const { line } of this.seats) line?.close();
    this.server.close();
  }

  /** Breaks all connections, as a bad network would. */
  drop(): void {
    for (const { line } of this.seats) line?.close();
  }

  seat(wantsHand: boolean): { id: number; hand: number } {
    const taken = this.pupils().map(({ hand }) => hand);
    const free = Array.from({ length: HANDS }, (_, hand) => hand).find((hand) => !taken.includes(hand));
    return { id: ++this.members, hand: wantsHand ? (free ?? -1) : -1 };
  }

  obey(pupil: Pupil, control: Record<string, unknown>): Refusal | null {
    this.heard.push(control);
    const wish = String(control['do']);
    const refused = wish.startsWith('class_') ? this.classroom.obey(pupil, control) : this.lead(pupil, wish, control);
    this.announce();
    return refused;
  }

  announce(): void {
    this.classroom.pupils = this.pupils();
    for (const seat of this.seats) {
      if (seat.pupil) seat.send(FrameType.Control, jsonBytes(this.classroom.announcement(seat.pupil)));
    }
  }

  private lead({ role }: Pupil, wish: string, { common, difference, on }: Record<string, unknown>): Refusal | null {
    const { world } = this;
    if (role !== 'instructor') return NOT_INSTRUCTOR;
    if (wish === 'co_contract') Object.assign(world, { common, difference });
    else if (wish === 'hold_posture' || wish === 'gravity') Object.assign(world, { [wish]: on });
    else if (wish === 'pause') world.paused = on === true;
    return null;
  }

  private pupils(): Pupil[] {
    return [...this.seats].flatMap(({ pupil }) => pupil ?? []);
  }

  private show(): void {
    const picture = this.world.picture(PICTURE_MS / 1000);
    for (const seat of this.seats) if (seat.pupil) seat.send(FrameType.Picture, picture);
  }

  private open(request: IncomingMessage, socket: Duplex): void {
    const seat = new Seat(this);
    const ended = () => {
      this.seats.delete(seat);
      if (seat.pupil && seat.pupil.hand >= 0) this.world.hold(seat.pupil.hand, null);
      this.announce();
    };
    seat.line = accept(request, socket, (message) => seat.take(message), ended);
    this.seats.add(seat);
  }

  private answer(request: IncomingMessage, response: ServerResponse): void {
    const { pathname } = new URL(request.url ?? '/', 'http://localhost');
    const language = /^\/languages\/([a-z]+)\.json$/.exec(pathname)?.[1];
    const file = join(this.dist, pathname === '/' ? 'index.html' : pathname);
    if (language) send(response, 'application/json', JSON.stringify(texts(language)));
    else if (pathname === '/scene.json') send(response, 'application/json', JSON.stringify(sceneFacts()));
    else if (pathname === '/lessons.json') send(response, 'application/json', JSON.stringify(this.lessons));
    else if (file.startsWith(this.dist) && existsSync(file))
      send(response, TYPES[extname(file)] ?? '', readFileSync(file), policy(request));
    else response.writeHead(404).end();
  }
}

/** As the server sends it. */
function policy({ headers }: IncomingMessage): string {
  const sources = `script-src 'self'; style-src 'self'; img-src 'self' data: blob:`;
  const connections = `connect-src 'self' ws://${headers.host ?? ''}`;
  return `default-src 'none'; ${sources}; ${connections}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'`;
}

function send(
  response: ServerResponse,
  type: string,
  body: string | Buffer,
  content_policy = "default-src 'none'",
): void {
  response.writeHead(200, { 'content-type': `${type}; charset=utf-8`, 'content-security-policy': content_policy });
  response.end(body);
}

function texts(language: string): object {
  const folder = join(REPOSITORY, 'assets/languages', language);
  return Object.assign(
    {},
    ...readdirSync(folder).map((name) => JSON.parse(readFileSync(join(folder, name), 'utf8')) as object),
  ) as object;
}
