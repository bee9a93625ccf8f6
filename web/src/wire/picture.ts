/**
 * Pictures: what has changed since the picture before it that this page was sent, packed for slow lines
 * (`src/net/README.md`, Picture). Skins lie on a grid; the decoder keeps where each vertex lay last.
 */
import { unzlibSync, zlibSync } from 'fflate';
import { ByteReader, ByteWriter, WireError } from './cursor';
import type { Picture } from './moment';
import { decodeInForce, decodeReadings } from './readings';

export const GRID_M = 5e-5;
const HEAD_BYTES = 16;
const LONGEST_VARINT = 5;
const WITH_READINGS = 1;
const WITH_IN_FORCE = 2;

/** Places of vertices in grid widths: all x, then all y, then all z. */
type GridSkin = Int32Array;

export class PictureDecoder {
  private sequence = 0;
  private readonly skins = new Map<number, GridSkin>();
  private time_s = 0;
  private poses: Float32Array[] = [];
  private numbers: PackedNumbers = { readings: null, inForce: null };

  /** Throws a WireError for one that does not fit what came before it. */
  take(payload: Uint8Array): Picture {
    const { sequence, since } = head(payload);
    if (since !== 0 && since !== this.sequence) throw new WireError('a picture of changes to one that never came');
    if (since === 0) this.skins.clear();
    const reader = new ByteReader(inflate(payload.subarray(HEAD_BYTES)));
    const time_s = reader.f64();
    const poses = reader.list(() => reader.floats(12));
    const skins = this.takeSkins(reader);
    const packed = packedNumbers(reader);
    reader.end();
    const readings = packed.readings && decodeReadings(packed.readings);
    const inForce = packed.inForce && decodeInForce(packed.inForce);
    Object.assign(this, { sequence, time_s, poses });
    this.numbers = {
      readings: packed.readings ?? this.numbers.readings,
      inForce: packed.inForce ?? this.numbers.inForce,
    };
    return { sequence, time_s, skins, poses, readings, inForce };
  }

  /** The newest picture as one that needs none before it; null before the first. */
  whole(): Uint8Array | null {
    const { sequence, time_s, poses, skins, numbers } = this;
    return sequence === 0 ? null : encodeWhole({ sequence, time_s, poses, skins, ...numbers });
  }

  private takeSkins(reader: ByteReader): Map<number, Float32Array> {
    const changed = new Map<number, Float32Array>();
    const count = reader.u16();
    for (let i = 0; i < count; ++i) {
      const index = reader.u16();
      const vertices = reader.u32();
      changed.set(index, positions(this.moved(index, vertices, reader)));
    }
    return changed;
  }

  private moved(index: number, vertices: number, reader: ByteReader): GridSkin {
    if (3 * vertices > reader.left) throw new WireError('a skin that is shorter than it says');
    const grid = this.skins.get(index) ?? new Int32Array(3 * vertices);
    if (grid.length !== 3 * vertices) throw new WireError('a skin of another size than before');
    for (let i = 0; i < grid.length; ++i) grid[i]! += reader.varint();
    this.skins.set(index, grid);
    return grid;
  }
}

/** All of a moment; readings and what is in force as packed in frames of their own. */
export interface WholePicture extends PackedNumbers {
  sequence: number; // 1 and up
  time_s: number;
  poses: readonly Float32Array[];
  skins: ReadonlyMap<number, GridSkin>;
}

/** A picture that needs none before it. */
export function encodeWhole({ sequence, time_s, poses, skins, readings, inForce }: WholePicture): Uint8Array {
  const places = [...skins.values()].reduce((sum, grid) => sum + 6 + LONGEST_VARINT * grid.length, 0);
  const rest = 8 + 2 + 48 * poses.length + 2 + 1 + 8 + (readings?.length ?? 0) + (inForce?.length ?? 0);
  const body = new ByteWriter(new Uint8Array(places + rest)).f64(time_s).u16(poses.length);
  for (const pose of poses) body.f32(...pose);
  body.u16(skins.size);
  for (const [index, grid] of skins) {
    body.u16(index).u32(grid.length / 3);
    for (const place of grid) body.varint(place);
  }
  body.u8((readings ? WITH_READINGS : 0) | (inForce ? WITH_IN_FORCE : 0));
  for (const part of [readings, inForce]) if (part) body.u32(part.length).bytes(part);
  const packed = zlibSync(body.written(), { level: 1 });
  return new ByteWriter(new Uint8Array(HEAD_BYTES + packed.length)).u64(sequence).u64(0).bytes(packed).written();
}

/** Whether a picture can be read without those before it. */
export function isWhole(payload: Uint8Array): boolean {
  return head(payload).since === 0;
}

/** What the server waits for before it sends more than a slow line carries. */
export function encodePictureSeen(sequence: number): Uint8Array {
  return new ByteWriter(new Uint8Array(8)).u64(sequence).written();
}

function head(payload: Uint8Array): { sequence: number; since: number } {
  const reader = new ByteReader(payload);
  return { sequence: reader.count64(), since: reader.count64() };
}

function inflate(bytes: Uint8Array): Uint8Array {
  try {
    return unzlibSync(bytes);
  } catch {
    throw new WireError('a picture that cannot be unpacked');
  }
}

/** As they came, packed as frames of their own. */
interface PackedNumbers {
  readings: Uint8Array | null;
  inForce: Uint8Array | null;
}

function packedNumbers(reader: ByteReader): PackedNumbers {
  const parts = reader.u8();
  const part = () => reader.slice(reader.u32());
  const readings = (parts & WITH_READINGS) !== 0 ? part() : null;
  const inForce = (parts & WITH_IN_FORCE) !== 0 ? part() : null;
  return { readings, inForce };
}

function positions(grid: GridSkin): Float32Array {
  const vertices = grid.length / 3;
  const out = new Float32Array(grid.length);
  for (let v = 0; v < vertices; ++v) {
    out[3 * v] = GRID_M * grid[v]!;
    out[3 * v + 1] = GRID_M * grid[vertices + v]!;
    out[3 * v + 2] = GRID_M * grid[2 * vertices + v]!;
  }
  return out;
}
