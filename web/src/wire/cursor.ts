/** Numbers one after the other, little-endian, out of bytes and into them. */

export class WireError extends Error {}

const utf8 = new TextDecoder('utf-8', { fatal: true });
const encoder = new TextEncoder();

export class ByteReader {
  private readonly view: DataView;
  private at = 0;

  constructor(private readonly bytes: Uint8Array) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  }

  get left(): number {
    return this.bytes.length - this.at;
  }

  u8 = (): number => this.view.getUint8(this.take(1));
  i8 = (): number => this.view.getInt8(this.take(1));
  u16 = (): number => this.view.getUint16(this.take(2), true);
  u32 = (): number => this.view.getUint32(this.take(4), true);
  i32 = (): number => this.view.getInt32(this.take(4), true);
  f32 = (): number => this.view.getFloat32(this.take(4), true);
  f64 = (): number => this.view.getFloat64(this.take(8), true);
  u64 = (): bigint => this.view.getBigUint64(this.take(8), true);
  /** Exact up to 2^53, more than any count or clock reaches. */
  count64 = (): number => Number(this.u64());

  flag = (): boolean => {
    const byte = this.u8();
    if (byte > 1) throw new WireError('a flag that is neither 0 nor 1');
    return byte === 1;
  };

  point = (): [number, number, number] => [this.f64(), this.f64(), this.f64()];

  /** One of `names` by its number. */
  choice<T>(names: readonly T[]): T {
    const name = names[this.u8()];
    if (name === undefined) throw new WireError('a number outside its list');
    return name;
  }

  list<T>(element: () => T): T[] {
    return Array.from({ length: this.u16() }, element);
  }

  doubles(count: number): Float64Array {
    const numbers = new Float64Array(count);
    for (let i = 0; i < count; ++i) numbers[i] = this.f64();
    return numbers;
  }

  floats(count: number): Float32Array {
    const numbers = new Float32Array(count);
    for (let i = 0; i < count; ++i) numbers[i] = this.f32();
    return numbers;
  }

  /** Zigzag, 7 bits a byte, the lowest first. */
  varint = (): number => {
    let zigzag = 0;
    for (let shift = 0; shift < 35; shift += 7) {
      const byte = this.u8();
      zigzag |= (byte & 0x7f) << shift;
      if (byte < 0x80) break;
    }
    return (zigzag >>> 1) ^ -(zigzag & 1);
  };

  /** The next bytes as they lie there. */
  slice(size: number): Uint8Array {
    const from = this.take(size);
    return this.bytes.subarray(from, from + size);
  }

  text(size: number): string {
    const from = this.take(size);
    try {
      return utf8.decode(this.bytes.subarray(from, from + size));
    } catch {
      throw new WireError('a text that is not UTF-8');
    }
  }

  /** Nothing may be left. */
  end(): void {
    if (this.left !== 0) throw new WireError('a frame that is longer than it says');
  }

  private take(size: number): number {
    if (size > this.left) throw new WireError('a frame that is shorter than it says');
    const from = this.at;
    this.at += size;
    return from;
  }
}

export class ByteWriter {
  private readonly view: DataView;
  private at = 0;

  constructor(private readonly room: Uint8Array) {
    this.view = new DataView(room.buffer, room.byteOffset, room.byteLength);
  }

  u8(value: number): this {
    this.view.setUint8(this.step(1), value);
    return this;
  }
  i8(value: number): this {
    this.view.setInt8(this.step(1), value);
    return this;
  }
  u16(value: number): this {
    this.view.setUint16(this.step(2), value, true);
    return this;
  }
  u32(value: number): this {
    this.view.setUint32(this.step(4), value, true);
    return this;
  }
  i32(...values: number[]): this {
    for (const value of values) this.view.setInt32(this.step(4), value, true);
    return this;
  }
  u64(value: bigint | number): this {
    this.view.setBigUint64(this.step(8), BigInt(value), true);
    return this;
  }
  f64(...values: number[]): this {
    for (const value of values) this.view.setFloat64(this.step(8), value, true);
    return this;
  }
  f32(...values: number[]): this {
    for (const value of values) this.view.setFloat32(this.step(4), value, true);
    return this;
  }
  /** Zigzag, 7 bits a byte, the lowest first. */
  varint(value: number): this {
    let zigzag = ((value << 1) ^ (value >> 31)) >>> 0;
    for (; zigzag >= 0x80; zigzag >>>= 7) this.u8((zigzag & 0x7f) | 0x80);
    return this.u8(zigzag);
  }
  bytes(values: Uint8Array): this {
    this.room.set(values, this.step(values.length));
    return this;
  }

  /** What was written so far. */
  written(): Uint8Array {
    return this.room.slice(0, this.at);
  }

  private step(size: number): number {
    const from = this.at;
    this.at += size;
    return from;
  }
}

/** UTF-8 of at most `most` bytes that ends with a whole character. */
export function utf8Bytes(text: string, most: number): Uint8Array {
  const bytes = encoder.encode(text);
  let size = Math.min(bytes.length, most);
  while (size < bytes.length && size > 0 && (bytes[size]! & 0xc0) === 0x80) --size;
  return bytes.subarray(0, size);
}
