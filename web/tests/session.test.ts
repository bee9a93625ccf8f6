import assert from 'node:assert/strict';
import { afterEach, beforeEach, test } from 'node:test';
import type { Connection } from '../src/app/state';
import { Session } from '../src/net/session';
import { FrameType } from '../src/wire/frame';
import { decodeHello } from '../src/wire/small';
import { PageSocket } from './fake/page_socket';

const real = { WebSocket: globalThis.WebSocket, random: Math.random, setTimeout: globalThis.setTimeout };
let pauses_ms: number[] = [];
let connections: Connection[] = [];
let session: Session;

/** Timers of the session that wait to connect again run at once; how long they would have waited is noted. */
function runAtOnce(callback: () => void, pause_ms: number): NodeJS.Timeout {
  pauses_ms.push(pause_ms);
  return real.setTimeout(callback, 0);
}

const nextTurn = () => new Promise((resolve) => real.setTimeout(resolve, 5));
const newest = (): PageSocket => PageSocket.made.at(-1) as PageSocket;
const nothing = () => undefined;

async function open(): Promise<bigint> {
  await nextTurn();
  newest().open();
  const hello = newest().heard.find(({ type }) => type === FrameType.Hello);
  return decodeHello(hello?.payload ?? new Uint8Array(0)).resume_id;
}

beforeEach(() => {
  Object.assign(globalThis, { WebSocket: PageSocket, setTimeout: runAtOnce });
  Math.random = () => 0.5;
  [PageSocket.made, pauses_ms, connections] = [[], [], []];
  session = new Session({
    ...{ url: 'ws://test/', token: new Uint8Array(16), role: 'student', name: 'Zoë', resume_id: 7n },
    onWelcome: nothing,
    onFrame: nothing,
    onConnection: (connection) => connections.push(connection),
  });
});

afterEach(() => {
  session.end('test');
  Object.assign(globalThis, { WebSocket: real.WebSocket, setTimeout: real.setTimeout });
  Math.random = real.random;
});

test('who has a hand asks for it again after a break', async () => {
  assert.equal(await open(), 7n);
  newest().welcome(0, 9n);
  newest().close();
  assert.equal(await open(), 9n);
});

test('who only watches joins anew after a break', async () => {
  await open();
  newest().welcome(-1, 9n);
  newest().close();
  assert.equal(await open(), 0n);
});

test('who is told that all hands are taken joins to watch', async () => {
  await open();
  newest().bye('no hand');
  assert.deepEqual(connections.at(-1), { state: 'broken', key: 'web.net.no_hand' });
  assert.equal(await open(), 0n);
});

test('pauses grow until a picture has come', async () => {
  for (let i = 0; i < 5; ++i) {
    await open();
    newest().welcome(0, 9n);
    newest().close();
  }
  assert.deepEqual(pauses_ms, [500, 1000, 2000, 4000, 5000]);
  await open();
  newest().welcome(0, 9n);
  newest().give(FrameType.Picture);
  newest().close();
  assert.equal(pauses_ms.at(-1), 500);
  Math.random = () => 0;
  await open();
  newest().close();
  assert.equal(pauses_ms.at(-1), 500, 'half of 1000');
});

test('a session that was ended never comes back', async () => {
  await open();
  newest().welcome(0, 9n);
  const socket = newest();
  session.end('web.net.reload');
  session.end('web.net.token');
  socket.open();
  await nextTurn();
  assert.deepEqual([PageSocket.made.length, socket.readyState], [1, PageSocket.OPEN]);
  assert.equal(socket.heard.filter(({ type }) => type === FrameType.Hello).length, 1, 'a late opening says nothing');
  assert.deepEqual(connections.at(-1), { state: 'ended', key: 'web.net.reload' });
});

test('an end while it waits to connect again is an end', async () => {
  await open();
  newest().close();
  session.end('web.net.reload');
  await nextTurn();
  assert.equal(PageSocket.made.length, 1);
});
