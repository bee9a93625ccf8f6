import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { parseFrame } from '../src/wire/frame';
import { isWhole, PictureDecoder } from '../src/wire/picture';
import { REPOSITORY } from './elbow';

const payload = (name: string) => parseFrame(readFileSync(join(REPOSITORY, 'tests/net/vectors', name))).payload;

test('a whole picture of what was decoded says the same as the pictures before it', () => {
  const decoder = new PictureDecoder();
  assert.equal(decoder.whole(), null);
  const first = decoder.take(payload('picture.bin'));
  const change = decoder.take(payload('picture_change.bin'));
  const whole = decoder.whole();
  assert.ok(whole && isWhole(whole));
  const again = new PictureDecoder().take(whole);
  assert.deepEqual([again.sequence, again.time_s, again.poses], [change.sequence, change.time_s, change.poses]);
  assert.deepEqual(again.skins, new Map([...first.skins, ...change.skins]));
  assert.deepEqual(again.readings, change.readings ?? first.readings);
  assert.deepEqual(again.inForce, change.inForce ?? first.inForce);
});

test('pictures go on after a whole one', () => {
  const decoder = new PictureDecoder();
  decoder.take(payload('picture.bin'));
  const whole = decoder.whole();
  assert.ok(whole);
  const other = new PictureDecoder();
  other.take(whole);
  assert.deepEqual(other.take(payload('picture_change.bin')), decoder.take(payload('picture_change.bin')));
});
