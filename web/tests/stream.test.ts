import assert from 'node:assert/strict';
import { test } from 'node:test';
import { FrameStream } from '../src/net/frame_stream';
import { WireError } from '../src/wire/cursor';
import { frameBytes, FrameType } from '../src/wire/frame';

function frames(count: number, first = 0): Uint8Array[] {
  return Array.from({ length: count }, (_, i) => {
    const payload = new Uint8Array(8 * i).fill(i);
    return frameBytes({ type: FrameType.Readings, flags: 0, sequence: first + i, time_ns: 1000 * i, payload });
  });
}

const joined = (pieces: Uint8Array[]): Uint8Array => Uint8Array.from(pieces.flatMap((piece) => [...piece]));

test('frames come out of pieces of any size', () => {
  const sent = frames(5);
  const bytes = joined(sent);
  for (const size of [1, 7, 24, 61, bytes.length]) {
    const stream = new FrameStream();
    const got = [];
    for (let at = 0; at < bytes.length; at += size) got.push(...stream.push(bytes.subarray(at, at + size)));
    assert.deepEqual(
      got.map(({ raw }) => [...raw]),
      sent.map((raw) => [...raw]),
      `pieces of ${size}`,
    );
  }
});

test('a frame that is missing, or comes twice, is refused', () => {
  assert.throws(() => new FrameStream().push(frames(1, 1)[0]!), WireError);
  const stream = new FrameStream();
  const [first] = frames(1);
  stream.push(first!);
  assert.throws(() => stream.push(first!), WireError);
});

test('what is no frame is refused at its header, however long it says it is', () => {
  const [frame] = frames(1);
  const long = frame!.slice(0, 24);
  new DataView(long.buffer).setUint32(4, 1 << 24, true);
  assert.throws(() => new FrameStream().push(long), WireError);
  const other = frame!.slice();
  other[0] = 0x47;
  assert.throws(() => new FrameStream().push(other), WireError);
  const unknown = frame!.slice();
  unknown[2] = 99;
  assert.throws(() => new FrameStream().push(unknown), WireError);
});
