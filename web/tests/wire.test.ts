import assert from 'node:assert/strict';
import { test } from 'node:test';
import { crc32 } from '../src/wire/crc32';
import { WireError } from '../src/wire/cursor';
import { frameBytes, FrameType, parseFrame } from '../src/wire/frame';
import { decodeInForce } from '../src/wire/readings';
import * as small from '../src/wire/small';
import {
  decodeToolContact,
  decodeToolGrip,
  decodeToolState,
  toolStateParts,
  type ToolState,
} from '../src/wire/tool_state';
import { allVectors, vector } from './vectors';

test('CRC-32 is that of zlib', () => {
  const text = new TextEncoder().encode('123456789');
  assert.equal(crc32(text), 0xcbf43926);
  assert.equal(crc32(text.subarray(0, 4), text.subarray(4)), 0xcbf43926);
});

test('every golden frame is read and written back byte for byte', () => {
  for (const { entry, bytes } of allVectors()) {
    const frame = parseFrame(bytes);
    assert.equal(frame.type, FrameType[entry.type as keyof typeof FrameType], entry.file);
    assert.deepEqual([frame.flags, frame.sequence, frame.time_ns], [entry.flags, entry.sequence, entry.time_ns]);
    assert.deepEqual(frameBytes(frame), bytes, entry.file);
  }
});

test('a frame with any byte changed is refused', () => {
  const { bytes } = vector('tool_state');
  for (let i = 0; i < bytes.length; ++i) {
    const tampered = bytes.slice();
    tampered[i]! ^= 0x10;
    assert.throws(() => parseFrame(tampered), WireError, `byte ${i}`);
  }
});

test('payloads of small frames are read and written back', () => {
  const both: [string, (payload: Uint8Array) => Uint8Array][] = [
    ['hello', (payload) => small.encodeHello(small.decodeHello(payload))],
    ['welcome', (payload) => small.encodeWelcome(small.decodeWelcome(payload))],
    ['force', (payload) => small.encodeForce(small.decodeForce(payload))],
    ['event', (payload) => small.encodeEvent(small.decodeEvent(payload))],
    ['ping', (payload) => small.encodePing(small.decodePing(payload))],
    ['pong', (payload) => small.encodePong(small.decodePong(payload))],
    ['bye', (payload) => small.encodeBye(small.decodeBye(payload))],
  ];
  for (const [name, again] of both) {
    const { payload } = vector(name).frame;
    assert.deepEqual(again(payload), payload, name);
  }
});

test('small frames hold what the manifest says', () => {
  const hello = small.decodeHello(vector('hello').frame.payload);
  assert.equal(hello.name, 'Zoë');
  assert.equal(hello.wants, small.Want.Hand | small.Want.Frames);
  assert.equal(hello.resume_id, 1234605616436508552n);
  assert.deepEqual(hello.token, small.tokenBytes('000102030405060708090a0b0c0d0e0f'));
  const welcome = small.decodeWelcome(vector('welcome').frame.payload);
  assert.deepEqual(welcome, { ...vector('welcome').fields, resume_id: 99n });
  const force = small.decodeForce(vector('force').frame.payload);
  assert.deepEqual(force.force_N, vector('force').fields['force_world_N']);
  assert.deepEqual([force.tool_sequence, force.step], [12345678901, 42]);
  assert.deepEqual(small.decodeBye(vector('bye').frame.payload), vector('bye').fields);
  assert.deepEqual(small.decodePong(vector('pong').frame.payload), vector('pong').fields);
});

test('a name ends with a whole character within 48 bytes', () => {
  const hello = small.decodeHello(vector('hello').frame.payload);
  const payload = small.encodeHello({ ...hello, name: 'ä'.repeat(30) + 'x' });
  assert.equal(small.decodeHello(payload).name, 'ä'.repeat(24));
});

test('the frames of a tool state are the golden ones', () => {
  const [contact, grip, state] = [vector('tool_contact'), vector('tool_grip'), vector('tool_state')];
  const { state: plain, third } = decodeToolState(state.frame.payload);
  const whole: ToolState = {
    ...plain,
    contact: decodeToolContact(contact.frame.payload, third),
    grip: decodeToolGrip(grip.frame.payload),
  };
  const parts = toolStateParts(whole);
  const frames = [contact, grip, state].map(({ frame }) => frame);
  assert.deepEqual(
    parts,
    frames.map(({ type, flags, payload }) => ({ type, flags, payload })),
  );
  assert.deepEqual(plain.tool_m, state.fields['tool_position_world_m']);
  assert.equal(whole.contact?.triangle, 77);
});

test('a tool state without touch is one frame without flags', () => {
  const { state } = decodeToolState(vector('tool_state').frame.payload);
  const parts = toolStateParts(state);
  assert.deepEqual(
    parts.map(({ type, flags }) => [type, flags]),
    [[FrameType.ToolState, 0]],
  );
});

test('what is in force', () => {
  assert.deepEqual(decodeInForce(vector('in_force').frame.payload), vector('in_force').fields);
});
