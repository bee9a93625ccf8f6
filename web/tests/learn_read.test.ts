import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { BadLesson } from '../src/learn/json_place';
import { mostPoints, type Lesson } from '../src/learn/lesson';
import { readLesson, readLessons } from '../src/learn/read_lesson';
import { anatomyOf, elbow, lessonOf, REPOSITORY } from './elbow';

function complaintOf(json: unknown): string {
  try {
    readLesson(json, elbow);
  } catch (failure) {
    assert.ok(failure instanceof BadLesson);
    return failure.message;
  }
  return '';
}

function stepOf(members: object): Lesson['steps'][0] {
  const step = readLesson(lessonOf(members), elbow).steps[0];
  assert.ok(step);
  return step;
}

test('every key of a step is read, defaults where it has none', () => {
  const step = stepOf({
    task: { kind: 'press', muscle: 'brachialis', band_N: [0.5, 1.5] },
    hints: ['h'],
    view: 'medial',
    show: { muscles: ['brachialis'], bones: [], faded: ['humerus'], labels: true },
    set: { common: 0.5, hold_posture: true },
  });
  assert.deepEqual(step.task, { kind: 'press', muscle: 1, low_N: 0.5, high_N: 1.5, hold_s: 1 });
  assert.deepEqual(step.show.muscles, [1]);
  assert.deepEqual(step.show.bones, []);
  assert.deepEqual(step.show.faded, [{ kind: 'bone', index: 1 }]);
  assert.equal(step.show.colour, 'activation');
  assert.deepEqual(step.set, { common: 0.5, hold_posture: true });
  assert.deepEqual([step.points, step.view, step.show.labels], [1, 'medial', true]);

  const read = stepOf({ points: 0 });
  assert.deepEqual([read.task.kind, read.points, read.view], ['read', 0, null]);
  const predict = stepOf({ task: { kind: 'predict', muscle: 'anconeus', joint: 'elbow', motion: 'extension' } });
  assert.deepEqual(predict.task, { kind: 'predict', muscle: 6, joint: 1, motion: 'extension', turn_rad: 0.0035 });
  const stiffen = stepOf({ task: { kind: 'stiffen', joint: 'elbow', factor: 2 } });
  assert.deepEqual(stiffen.task, { kind: 'stiffen', joint: 1, factor: 2, within_rad: 0.0349, hold_s: 1 });
});

/** As tests/learn/lesson_file_test.cpp has them: what is wrong is named with its place and a remedy. */
const REFUSED: [object, ...string[]][] = [
  [{ task: { kind: 'find', part: 'bicep_brachii' } }, '/steps/0/task/part', 'biceps_brachii'],
  [{ task: { kind: 'find', part: 7 } }, '/steps/0/task/part', 'is 7; must be a text'],
  [{ task: { kind: 'find' } }, '/steps/0/task', '"part" is missing'],
  [{ task: { kind: 'fnd', part: 'ulna' } }, '/steps/0/task/kind', 'nearest: "find"'],
  [{ task: { kind: 'find', part: 'ulna', hint: 'x' } }, '/steps/0/task/hint', 'unknown key'],
  [{ task: 'find' }, '/steps/0/task', 'must be an object'],
  [{ task: { kind: 'press', muscle: 'ulna', band_N: [1, 2] } }, 'muscle "ulna"'],
  [{ task: { kind: 'press', muscle: 'anconeus', band_N: [2, 1] } }, 'band_N', 'lowest, highest'],
  [{ task: { kind: 'press', muscle: 'anconeus', band_N: [1, 1e300] } }, 'band_N/1', 'and 20'],
  [{ task: { kind: 'press', muscle: 'anconeus', band_N: [1] } }, 'band_N', 'must have 2'],
  [{ task: { kind: 'predict', muscle: 'anconeus', joint: 'knee', motion: 'flexion' } }, '/task/joint', 'no joint'],
  [{ task: { kind: 'predict', muscle: 'anconeus', joint: 'elbow', motion: 'bend' } }, 'flexion, extension'],
  [{ task: { kind: 'stiffen', joint: 'elbow', factor: 1 } }, '/steps/0/task/factor', '1.1'],
  [{ task: { kind: 'name', part: 'ulna', options: ['ulna'] } }, 'has 1 options', '2 to 12'],
  [{ task: { kind: 'name', part: 'ulna', options: ['radius', 'humerus'] } }, '/task/options', 'add "ulna"'],
  [{ task: { kind: 'identify', part: 'ulna', options: ['ulna', 'ulna'] } }, '/options/1', 'once'],
  [{ show: { muscles: ['humerus'] } }, '/steps/0/show/muscles/0', 'no muscle "humerus"'],
  [{ show: { colour: 'red' } }, '/steps/0/show/colour', 'kind'],
  [{ set: { common: 2 } }, '/steps/0/set/common', 'between 0 and 1'],
  [{ set: { flexors: 1 } }, '/steps/0/set', 'extensors'],
  [{ set: { flexors: 1, extensors: 1, common: 0 } }, '/steps/0/set', 'either'],
  [{ view: 'anterior' }, '/steps/0/view', 'cranial'],
  [{ points: -1 }, '/steps/0/points'],
  [{ points: 5 }, 'reading earns no points'],
  [{ hints: ['a', 'b', 'c', 'd', 'e'] }, '/steps/0/hints', 'at most 4'],
  [{ hints: [''] }, '/steps/0/hints/0', 'is empty'],
  [{ titel: 'x' }, '/steps/0/titel', '"title"'],
];

test('a step that breaks a rule is refused with place and remedy', () => {
  for (const [members, ...words] of REFUSED) {
    const complaint = complaintOf(lessonOf(members));
    for (const word of words) assert.ok(complaint.includes(word), `${JSON.stringify(members)}: ${complaint}`);
  }
});

test('a joint cannot be stiffened where nothing opposes', () => {
  const json = lessonOf({ task: { kind: 'stiffen', joint: 'elbow', factor: 2 } });
  assert.throws(() => readLesson(json, { ...elbow, hasOpposingMuscles: false }), /no opposing muscles/);
});

test('another version is refused before its keys', () => {
  assert.match(complaintOf({ schema: 2, chapters: [] }), /version 2.*newer Myotact/);
  assert.match(complaintOf({ schema: 0 }), /write "schema": 1/);
  assert.match(complaintOf({ schema: '1' }), /must be a number/);
  assert.match(complaintOf({ key: 'l' }), /"schema" is missing/);
});

test('lessons without steps, of bad keys and of no shape are refused', () => {
  const head = { schema: 1, title: 'T', scene: 'elbow' };
  assert.match(complaintOf({ ...head, key: 'l', steps: [] }), /has 0 steps; must have 1 to 200/);
  assert.match(complaintOf({ ...head, key: 'l', steps: {} }), /must be a list/);
  assert.match(complaintOf({ ...head, key: '../l', steps: [{}] }), /\/key: must be 1 to 60/);
  assert.match(complaintOf({ ...head, key: 'l', steps: [{}] }), /\/steps\/0: the key "title"/);
  assert.match(complaintOf({ ...head, key: 'l', steps: [3] }), /\/steps\/0/);
  assert.match(complaintOf([]), /must be an object/);
  assert.match(complaintOf(null), /must be an object/);
});

test('a list keeps broken lessons with what is wrong with them', () => {
  const good = lessonOf({});
  const list = readLessons([good, { title: 'Broken', schema: 1 }, 7], elbow);
  assert.equal(list[0]?.lesson?.key, 'l');
  assert.match(list[1]?.complaint ?? '', /"key" is missing/);
  assert.deepEqual([list[1]?.name, list[2]?.name], ['Broken', '3']);
  assert.deepEqual(readLessons({}, elbow), []);
});

test('the shipped lessons are read', () => {
  const folder = join(REPOSITORY, 'assets', 'lessons');
  const specimens: Record<string, string> = {
    elbow: 'canine_elbow',
    forelimb: 'canine_whole_forelimb',
    hindlimb: 'canine_whole_hindlimb',
    stifle: 'canine_whole_hindlimb',
    hock: 'canine_whole_hindlimb',
  };
  for (const file of readdirSync(folder).filter((name) => name.endsWith('.json'))) {
    const json = JSON.parse(readFileSync(join(folder, file), 'utf8')) as { scene: string };
    const lesson = readLesson(json, anatomyOf(specimens[json.scene] ?? ''));
    assert.ok(lesson.steps.length > 1 && mostPoints(lesson) > 0, file);
  }
});
