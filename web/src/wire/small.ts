/** Payloads of the small frames, but for those of a tool's state. */
import { ByteReader, ByteWriter, utf8Bytes } from './cursor';

export const PROTOCOL_VERSION = 1;
export const MOST_NAME_BYTES = 48;
const MOST_TEXT_BYTES = 96;
const SMALL = 104;

export const roles = ['viewer', 'student', 'instructor'] as const;
const handWishes = ['any', 'left', 'right'] as const;
const events = ['stop', 'refused'] as const;
export const byeReasons = ['leaving', 'bad frame', 'version', 'token', 'full', 'silent', 'no hand', 'closing'] as const;

export const Want = { Hand: 1, Frames: 2, Readings: 4, Meshes: 8, InForce: 16, Pictures: 32, Class: 64 } as const;

export interface Hello {
  version: number;
  role: (typeof roles)[number];
  wants: number;
  hand: (typeof handWishes)[number];
  resume_id: bigint;
  token: Uint8Array;
  name: string;
}

export interface Welcome {
  client: number;
  resume_id: bigint;
  /** -1: none is free. */
  hand: number;
  role: (typeof roles)[number];
  lockstep: boolean;
  step_ns: number;
  server_time_ns: number;
}

export interface Force {
  tool_sequence: number;
  step: number;
  force_N: [number, number, number];
}

export interface Event {
  code: (typeof events)[number];
  value: number;
  text: string;
}

export interface Pong {
  ping_ns: number;
  arrived_ns: number;
  left_ns: number;
}

export interface Bye {
  reason: (typeof byeReasons)[number];
  text: string;
}

const payload = (): ByteWriter => new ByteWriter(new Uint8Array(SMALL));

/** 16 bytes of 32 hexadecimal digits; zeros for anything else. */
export function tokenBytes(hex: string): Uint8Array {
  const token = new Uint8Array(16);
  if (!/^[0-9a-fA-F]{32}$/.test(hex)) return token;
  for (let i = 0; i < 16; ++i) token[i] = parseInt(hex.slice(2 * i, 2 * i + 2), 16);
  return token;
}

export function encodeHello(hello: Hello): Uint8Array {
  const writer = payload().u16(hello.version).u8(roles.indexOf(hello.role)).u8(hello.wants);
  writer.u8(handWishes.indexOf(hello.hand)).u64(hello.resume_id).bytes(hello.token);
  return writer.bytes(utf8Bytes(hello.name, MOST_NAME_BYTES)).written();
}

export function decodeHello(bytes: Uint8Array): Hello {
  const reader = new ByteReader(bytes);
  const [version, role, wants, hand] = [reader.u16(), reader.choice(roles), reader.u8(), reader.choice(handWishes)];
  const resume_id = reader.u64();
  const token = Uint8Array.from({ length: 16 }, reader.u8);
  return { version, role, wants, hand, resume_id, token, name: reader.text(reader.left) };
}

export function encodeWelcome(welcome: Welcome): Uint8Array {
  const writer = payload().u32(welcome.client).u64(welcome.resume_id).i8(welcome.hand);
  writer.u8(roles.indexOf(welcome.role)).u8(welcome.lockstep ? 1 : 0);
  return writer.u64(welcome.step_ns).u64(welcome.server_time_ns).written();
}

export function decodeWelcome(bytes: Uint8Array): Welcome {
  const reader = new ByteReader(bytes);
  const welcome = {
    client: reader.u32(),
    resume_id: reader.u64(),
    hand: reader.i8(),
    role: reader.choice(roles),
    lockstep: reader.flag(),
    step_ns: reader.count64(),
    server_time_ns: reader.count64(),
  };
  reader.end();
  return welcome;
}

export function encodeForce(force: Force): Uint8Array {
  return payload()
    .u64(force.tool_sequence)
    .u64(force.step)
    .f64(...force.force_N)
    .written();
}

export function decodeForce(bytes: Uint8Array): Force {
  const reader = new ByteReader(bytes);
  const force = { tool_sequence: reader.count64(), step: reader.count64(), force_N: reader.point() };
  reader.end();
  return force;
}

export function encodeEvent(event: Event): Uint8Array {
  const writer = payload()
    .u8(events.indexOf(event.code) + 1)
    .i32(event.value);
  return writer.bytes(utf8Bytes(event.text, MOST_TEXT_BYTES)).written();
}

export function decodeEvent(bytes: Uint8Array): Event {
  const reader = new ByteReader(bytes);
  return { code: reader.choice([undefined, ...events])!, value: reader.i32(), text: reader.text(reader.left) };
}

export function encodePing(sent_ns: number): Uint8Array {
  return payload().u64(sent_ns).written();
}

export function decodePing(bytes: Uint8Array): number {
  return new ByteReader(bytes).count64();
}

export function encodePong(pong: Pong): Uint8Array {
  return payload().u64(pong.ping_ns).u64(pong.arrived_ns).u64(pong.left_ns).written();
}

export function decodePong(bytes: Uint8Array): Pong {
  const reader = new ByteReader(bytes);
  return { ping_ns: reader.count64(), arrived_ns: reader.count64(), left_ns: reader.count64() };
}

export function encodeBye(bye: Bye): Uint8Array {
  const writer = payload().u8(byeReasons.indexOf(bye.reason));
  return writer.bytes(utf8Bytes(bye.text, MOST_TEXT_BYTES)).written();
}

export function decodeBye(bytes: Uint8Array): Bye {
  const reader = new ByteReader(bytes);
  return { reason: reader.choice(byeReasons), text: reader.text(reader.left) };
}
