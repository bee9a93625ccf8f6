import assert from 'node:assert/strict';
import { test } from 'node:test';
import { controlsOf, lookOfStep } from '../src/learn/lesson_look';
import { readLesson } from '../src/learn/read_lesson';
import type { InForce } from '../src/wire/moment';
import { elbow, lessonOf } from './elbow';

function lookOf(members: object) {
  const step = readLesson(lessonOf(members), elbow).steps[0];
  assert.ok(step);
  return lookOfStep(step, elbow, 'latin');
}

test('a step shows everything unless it says otherwise', () => {
  const plain = lookOf({});
  assert.deepEqual(
    [plain.only, plain.parts, plain.labels, plain.names, plain.marked],
    [null, {}, false, 'latin', null],
  );
});

test('only what a step names is drawn; of the other kind everything', () => {
  assert.deepEqual(
    lookOf({ show: { muscles: [] } }).only,
    elbow.bones.map(({ key }) => key),
  );
  assert.deepEqual(lookOf({ show: { muscles: ['brachialis'], bones: ['ulna'] } }).only, ['brachialis', 'ulna']);
});

test('names are hidden while a task asks for them, whatever labels says', () => {
  const show = { labels: true, colour: 'kind', faded: ['ulna'] };
  const find = lookOf({ show, task: { kind: 'find', part: 'ulna' } });
  assert.deepEqual([find.labels, find.names, find.marked], [false, 'none', null]);
  assert.deepEqual([find.colour, find.parts], ['kind', { ulna: 'faded' }]);
  const touch = lookOf({ show, task: { kind: 'touch', part: 'ulna' } });
  assert.deepEqual([touch.labels, touch.names], [true, 'latin']);
});

test('what a task is about is marked, unless where it lies is the task', () => {
  assert.equal(lookOf({ task: { kind: 'name', part: 'ulna' } }).marked, 'ulna');
  assert.equal(lookOf({ task: { kind: 'press', muscle: 'anconeus', band_N: [1, 2] } }).marked, 'anconeus');
  assert.equal(lookOf({ task: { kind: 'identify', part: 'ulna', options: ['ulna', 'radius'] } }).marked, null);
});

test('a setting becomes the controls of an instructor; what it does not name stays', () => {
  const now = { common: 0.3, difference: -0.2 } as InForce;
  assert.deepEqual(controlsOf({}, now), []);
  assert.deepEqual(controlsOf({ common: 0.5 }, now), [{ do: 'co_contract', common: 0.5, difference: -0.2 }]);
  assert.deepEqual(controlsOf({ difference: 1, gravity: false }, null), [
    { do: 'co_contract', common: 0, difference: 1 },
    { do: 'gravity', on: false },
  ]);
  assert.deepEqual(controlsOf({ flexors: 1, extensors: 0, hold_posture: true }, now), [
    { do: 'levels', flexors: 1, extensors: 0 },
    { do: 'hold_posture', on: true },
  ]);
});
