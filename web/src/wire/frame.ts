/** The frame that all messages travel in: `src/net/README.md`, A frame. */
import { crc32 } from './crc32';
import { ByteReader, ByteWriter, WireError } from './cursor';

export const FrameType = {
  Hello: 1,
  Welcome: 2,
  ToolState: 3,
  ToolContact: 4,
  ToolGrip: 5,
  Force: 6,
  Event: 7,
  Ping: 8,
  Pong: 9,
  Bye: 10,
  LocalModel: 16,
  SceneKey: 17,
  SceneDelta: 18,
  BonePoses: 19,
  Readings: 20,
  Mesh: 21,
  InForce: 22,
  Picture: 23,
  PictureSeen: 24,
  Control: 32,
} as const;

export const HEADER_BYTES = 24;
const MAGIC = 0x4d;
const HEADER_VERSION = 1;
const CRC_OFFSET = 20;
const MOST_SMALL = 104;
const MOST_PAYLOAD = 1 << 20;
const MOST_CONTROL = 1 << 16;

export interface Frame {
  type: number;
  flags: number;
  sequence: number;
  time_ns: number;
  payload: Uint8Array;
}

/** Without the check of its sum, which needs the payload. */
export interface FrameHeader {
  type: number;
  flags: number;
  length: number;
  sequence: number;
  time_ns: number;
  crc: number;
}

const smallAbove = new Set<number>([FrameType.InForce, FrameType.PictureSeen]);

function mostPayload(type: number): number {
  if (type === FrameType.Control) return MOST_CONTROL;
  return type <= FrameType.Bye || smallAbove.has(type) ? MOST_SMALL : MOST_PAYLOAD;
}

const knownTypes = new Set<number>(Object.values(FrameType));

/** Throws a WireError for what cannot be the beginning of a frame. */
export function parseHeader(bytes: Uint8Array): FrameHeader {
  const reader = new ByteReader(bytes.subarray(0, HEADER_BYTES));
  if (reader.u8() !== MAGIC || reader.u8() !== HEADER_VERSION) throw new WireError('no frame of this format');
  const header = {
    type: reader.u8(),
    flags: reader.u8(),
    length: reader.u32(),
    sequence: reader.u32(),
    time_ns: reader.count64(),
    crc: reader.u32(),
  };
  if (!knownTypes.has(header.type)) throw new WireError(`a frame of unknown type ${header.type}`);
  if (header.length > mostPayload(header.type)) throw new WireError('a frame longer than its type ever is');
  return header;
}

/** The one frame that `bytes` is. */
export function parseFrame(bytes: Uint8Array): Frame {
  const { type, flags, length, sequence, time_ns, crc } = parseHeader(bytes);
  const payload = bytes.subarray(HEADER_BYTES);
  if (payload.length !== length) throw new WireError('a frame of another length than it says');
  if (crc32(bytes.subarray(0, CRC_OFFSET), payload) !== crc) throw new WireError('a frame with a wrong check sum');
  return { type, flags, sequence, time_ns, payload };
}

export function frameBytes({ type, flags, sequence, time_ns, payload }: Frame): Uint8Array {
  const bytes = new Uint8Array(HEADER_BYTES + payload.length);
  const writer = new ByteWriter(bytes);
  writer.u8(MAGIC).u8(HEADER_VERSION).u8(type).u8(flags).u32(payload.length).u32(sequence).u64(time_ns);
  writer.u32(crc32(bytes.subarray(0, CRC_OFFSET), payload)).bytes(payload);
  return bytes;
}
