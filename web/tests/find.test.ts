import assert from 'node:assert/strict';
import { test } from 'node:test';
import { findParts, plainWords } from '../src/find/search';
import { nearestWord, typingSlips } from '../src/find/slips';
import { anatomyOf, elbow } from './elbow';

function found(text: string, anatomy = elbow): string[] {
  const parts = findParts(text, anatomy.muscles, anatomy.bones);
  return parts.map(({ kind, index }) => (kind === 'muscle' ? anatomy.muscles : anatomy.bones)[index]?.key ?? '');
}

test('slips are letters wrong, missing, too many, and neighbours swapped', () => {
  const cases: [string, string, number][] = [
    ['', '', 0],
    ['', 'ulna', 4],
    ['ulna', 'ulna', 0],
    ['una', 'ulna', 1],
    ['ullna', 'ulna', 1],
    ['unla', 'ulna', 1],
    ['ulma', 'ulna', 1],
    ['bicesp', 'biceps', 1],
    ['biceps', 'triceps', 2],
    ['ca', 'abc', 3], // no letter is moved twice
  ];
  for (const [a, b, slips] of cases) {
    assert.equal(typingSlips(a, b), slips, `${a} ${b}`);
    assert.equal(typingSlips(b, a), slips, `${b} ${a}`);
  }
});

test('names are found by beginning, by a piece, and with slips', () => {
  assert.equal(found('biceps')[0], 'biceps_brachii');
  assert.equal(found('bicpes')[0], 'biceps_brachii');
  assert.equal(found('BICEPS  brach')[0], 'biceps_brachii');
  assert.equal(found('brachii biceps')[0], 'biceps_brachii');
  assert.equal(found('brachalis')[0], 'brachialis');
  assert.equal(found('umer')[0], 'humerus');
  assert.equal(found('elbow bone')[0], 'ulna');
});

test('a beginning comes before a piece, a piece before a slip', () => {
  const parts = ['ligament', 'stylium', 'tyl', 'tyle major', 'tal'].map((key) => {
    return { key, english: key, latin: '', synonyms: [] };
  });
  const order = findParts('tyl', parts, []).map(({ index }) => parts[index]?.key);
  assert.deepEqual(order, ['tyl', 'tyle major', 'stylium']);
});

test('nothing is found for what nothing is called, nor for signs alone', () => {
  assert.deepEqual(found('xyzzyx'), []);
  assert.deepEqual(found(' .,; '), []);
  assert.deepEqual(found('b'.repeat(100000)), []);
});

test('accents and sharp s do not matter', () => {
  assert.deepEqual(plainWords('Großer Rückenmuskel, É'), ['grosser', 'ruckenmuskel', 'e']);
});

test('a search of a whole limb is quick', () => {
  const limb = anatomyOf('canine_whole_hindlimb');
  assert.ok(found('gastrocnemis', limb).includes('gastrocnemius'));
  const start = performance.now();
  for (let i = 0; i < 20; ++i) found('semitendonosus musclee', limb);
  const most_ms = 100; // a few on a machine of its own; tests share theirs
  assert.ok((performance.now() - start) / 20 < most_ms);
});

test('the nearest word is named, a beginning counts as one slip', () => {
  assert.equal(nearestWord('bicep_brachii', ['brachialis', 'biceps_brachii']), 'biceps_brachii');
  assert.equal(nearestWord('gastroc', ['gracilis', 'gastrocnemius']), 'gastrocnemius');
  assert.equal(nearestWord('x', []), '');
});
