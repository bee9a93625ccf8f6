import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { SceneFacts } from '../src/app/facts';
import { fromElement } from '../src/app/licences';
import { inlinePage } from '../src/record/export_page';
import { Player } from '../src/record/player';
import { LONGEST_S, MOST_BYTES, Recorder } from '../src/record/recorder';
import { parseRecording, recordingText, type Recording } from '../src/record/recording';
import { FrameType, frameBytes, parseFrame } from '../src/wire/frame';
import { decodeWelcome } from '../src/wire/small';

const utf8 = new TextEncoder();

function frame(type: number, payload: Uint8Array = new Uint8Array(0)): Uint8Array {
  return frameBytes({ type, flags: 0, sequence: 0, time_ns: 0, payload });
}

function control(message: object): Uint8Array {
  return frame(FrameType.Control, utf8.encode(JSON.stringify(message)));
}

/** Its sequence, and that of the picture that it builds on. */
function picture(sequence: number, since: number): Uint8Array {
  return frame(FrameType.Picture, Uint8Array.of(sequence, 0, 0, 0, 0, 0, 0, 0, since, 0, 0, 0, 0, 0, 0, 0));
}

const noWhole = () => null;

const scene = { name: '</script><b>"quoted"' } as SceneFacts;

function recordingOf(frames: Recording['frames']): Recording {
  return { scene, dictionaries: {}, shade: Uint8Array.of(1, 255), frames };
}

test('a recording comes out of its text as it went in, and no markup is left in the text', () => {
  const frames = [
    {
      at_ms: 0,
      bytes: frame(
        FrameType.Mesh,
        Uint8Array.from({ length: 100000 }, (_, i) => i % 256),
      ),
    },
    { at_ms: 17, bytes: frame(FrameType.Picture) },
  ];
  const recording: Recording = {
    scene,
    dictionaries: { en: { a: '<!-- x' } },
    shade: new Uint8Array([1, 255]),
    frames,
  };
  const text = recordingText(recording);
  assert.ok(!text.includes('<'));
  assert.deepEqual(parseRecording(text), recording);
  assert.throws(() => parseRecording('{"schema": 2}'), /version 2/);
});

test("nobody's name, answer or key to the class is recorded", () => {
  const welcome = new Uint8Array(31).fill(1);
  const kept = [frame(FrameType.Mesh), picture(1, 0), control({ scene: {} })];
  const dropped = [control({ class: { members: [{ name: 'Zoë' }] } }), frame(FrameType.Force), frame(FrameType.Pong)];
  const recorder = new Recorder();
  recorder.start([frame(FrameType.Welcome, welcome), ...kept], 0);
  for (const other of dropped) recorder.take(other, 1, noWhole);
  const [first, ...rest] = recorder.frames.map(({ bytes }) => bytes);
  assert.deepEqual(rest, kept);
  const { client, resume_id, hand, role } = decodeWelcome(parseFrame(first as Uint8Array).payload);
  assert.deepEqual({ client, resume_id, hand, role }, { client: 0, resume_id: 0n, hand: -1, role: 'viewer' });
});

test('a recorder ends by itself after a minute and when it is full', () => {
  const recorder = new Recorder();
  assert.ok(!recorder.take(picture(1, 0), 0, noWhole), 'not started');
  recorder.start([], 1000);
  assert.ok(recorder.take(frame(FrameType.Mesh), 1000 + 1000 * LONGEST_S, noWhole));
  assert.ok(!recorder.take(frame(FrameType.Mesh), 1001 + 1000 * LONGEST_S, noWhole));
  assert.deepEqual([recorder.recording, recorder.frames.length, recorder.length_s], [false, 1, LONGEST_S]);

  recorder.start([], 0);
  const large = frame(FrameType.Mesh, new Uint8Array(1 << 20));
  let taken = 0;
  while (recorder.take(large, taken, noWhole)) ++taken;
  assert.equal(taken, Math.floor(MOST_BYTES / large.length));
});

test('a recorder keeps a whole picture every two seconds, before the one that builds on it', () => {
  const recorder = new Recorder();
  recorder.start([picture(10, 0)], 0);
  const wholes: number[] = [];
  const whole = (sequence: number) => () => {
    wholes.push(sequence);
    return picture(sequence, 0);
  };
  for (let i = 1; i <= 50; ++i) recorder.take(picture(10 + i, 9 + i), 100 * i, whole(9 + i));
  assert.deepEqual(wholes, [30, 51]);
  const kept = recorder.frames.map(({ at_ms, bytes }) => [at_ms, bytes[24], bytes[32]]);
  assert.deepEqual(kept.slice(20, 24), [
    [2000, 30, 29],
    [2000, 30, 0],
    [2100, 31, 30],
    [2200, 32, 31],
  ]);
});

test('a jump in pictures begins with the last whole one', () => {
  const frames = [picture(1, 0), picture(2, 1), picture(2, 0), picture(3, 2), picture(4, 3)].map((bytes, i) => ({
    at_ms: i,
    bytes,
  }));
  const given: number[] = [];
  const player = new Player(recordingOf(frames), { now_ms: () => 0, every: () => () => {} });
  player.start((bytes) => given.push(bytes[24] ?? 0));
  given.length = 0;
  player.seek(0.0035);
  assert.deepEqual(given, [2, 3]);
});

/** A whole picture at 0 and one at 20, a change of either. */
function played() {
  const names = new Map<Uint8Array, string>();
  const timed = (at_ms: number, name: string, bytes: Uint8Array) => {
    names.set(bytes, name);
    return { at_ms, bytes };
  };
  const frames = [
    timed(0, 'welcome', frame(FrameType.Welcome, new Uint8Array(31))),
    timed(0, 'mesh', frame(FrameType.Mesh)),
    timed(0, 'whole a', picture(1, 0)),
    timed(10, 'change a', picture(2, 1)),
    timed(20, 'whole b', picture(2, 0)),
    timed(30, 'change b', picture(3, 2)),
  ];
  let clock_ms = 0;
  let tick: (() => void) | null = null;
  const every = (_: number, wanted: () => void) => {
    tick = wanted;
    return () => (tick = null);
  };
  const player = new Player(recordingOf(frames), { now_ms: () => clock_ms, every });
  const given: string[] = [];
  const pass = (ms: number) => {
    clock_ms += ms;
    tick?.();
  };
  const since = () => given.splice(0);
  player.start((bytes) => given.push(names.get(bytes) ?? '?'));
  return { player, pass, since };
}

test('a player gives every frame at its time and stops at the end', () => {
  const { player, pass, since } = played();
  assert.deepEqual(since(), ['welcome', 'mesh', 'whole a']);
  pass(16);
  assert.deepEqual(since(), ['change a']);
  player.pause();
  pass(16);
  assert.deepEqual(since(), []);
  player.play();
  pass(16);
  assert.deepEqual(since(), ['whole b', 'change b']);
  assert.deepEqual([player.playing, player.time_s], [false, 0.03]);
  player.play();
  assert.equal(player.time_s, 0);
});

test('a jump gives what the moment is made of and nothing twice', () => {
  const { player, since } = played();
  player.pause();
  since();
  player.seek(0.015);
  assert.deepEqual(since(), ['whole a', 'change a']);
  player.seek(0.025);
  assert.deepEqual(since(), ['whole b']);
  player.seek(99);
  assert.deepEqual(since(), ['whole b', 'change b']);
});

test('an empty recording plays nothing', () => {
  const player = new Player(recordingOf([]));
  player.start(() => assert.fail());
  assert.deepEqual([player.playing, player.length_s], [false, 0]);
});

const PAGE = `<!doctype html><html><head><meta charset="utf-8" /><link rel="stylesheet" href="/app.css" />
<script type="module" src="/app.js"></script></head><body></body></html>`;

test('the exported page holds everything and asks for nothing', () => {
  const script = "const a = '</script>$&'; const b = '$1';";
  const licences = 'Licence of <a@b.c> &lt; </script>';
  const whole = inlinePage(PAGE, { style: 'a { color: red }', script, licences, recording: '{"schema":1}' });
  assert.ok(whole.includes('<style>a { color: red }</style>'));
  assert.ok(whole.includes("const a = '<\\/script>$&'; const b = '$1';"), whole);
  assert.ok(whole.includes('<script type="application/json" id="recording">{"schema":1}</script>'));
  assert.ok(!/\b(src|href)=/.test(whole));
  assert.ok(whole.indexOf('Content-Security-Policy') < whole.indexOf('<style>'));
  const held = /<script type="text\/plain" id="licences">([^<]*)<\/script>/.exec(whole)?.[1] ?? '';
  assert.equal(fromElement(held), licences);
  assert.throws(() => inlinePage('<html></html>', { style: '', script: '', licences: '', recording: '' }), /has no/);
});
