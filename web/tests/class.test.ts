import assert from 'node:assert/strict';
import { test } from 'node:test';
import { plainLook, type CameraPose } from '../src/app/look';
import { sentenceOf } from '../src/app/refusals';
import type { ClassResult, Member } from '../src/app/state';
import { Answers } from '../src/class/answers';
import { csvField, csvTable } from '../src/class/csv';
import { MOST_RESULTS, readClassState } from '../src/class/class_state';
import { countAnswers, makeQuestion, MOST_OPTIONS } from '../src/class/question';
import { linesOf, resultsCsv } from '../src/class/results';
import { packLook, unpackLook } from '../src/class/shared_look';
import { Throttle } from '../src/app/throttle';
import { shortLine } from '../src/text/short_line';

test('fields are quoted where they must be, and are no formulas', () => {
  assert.equal(csvField('plain'), 'plain');
  assert.equal(csvField('a,b "c"\n'), '"a,b ""c""\n"');
  assert.equal(csvField(-1.5), '-1.5');
  for (const formula of ['=1+1', '+1', '-1', '@SUM(A1)', '\t=1', '  =1'])
    assert.ok(csvField(formula).startsWith("'"), formula);
  assert.equal(csvField('\r=1'), '"\'\r=1"');
  assert.equal(csvField('a;=1'), "a;'=1");
  assert.equal(csvField('a\t-1;b - 2'), "a\t'-1;b - 2");
  assert.equal(csvField('a\n @1'), '"a\n\' @1"');
  assert.equal(csvField('=HYPERLINK("http://x","y")'), '"\'=HYPERLINK(""http://x"",""y"")"');
  assert.equal(
    csvTable([
      ['a', 1],
      ['b', 2],
    ]),
    '\uFEFFa,1\r\nb,2\r\n',
  );
});

let number = 0;
const result = (client: number, name: string, step: number, points: number): ClassResult => {
  return { number: ++number, client, name, lesson: 'l', step, answer: 'ulna', points, of: 2 };
};

test('a step that came twice counts once, as it came last', () => {
  const results = [result(2, 'Zoë', 2, 0), result(1, 'Ann', 2, 2), result(2, 'Zoë', 2, 1), result(2, 'Zoë', 3, 2)];
  assert.deepEqual(linesOf(results), [
    { client: 1, name: 'Ann', lesson: 'l', steps: 1, points: 2, of: 2 },
    { client: 2, name: 'Zoë', lesson: 'l', steps: 2, points: 3, of: 4 },
  ]);
  const lines = resultsCsv(results).split('\r\n');
  const head = '\uFEFFclient,name,lesson,step,answer,points,of,question';
  assert.deepEqual(lines.slice(0, 2), [head, '2,Zoë,l,2,ulna,1,2,']);
  assert.equal(lines.length, 5);
});

test('who comes back under another number is the same; two of one name that answer by turns are two', () => {
  const back = [result(1, 'Ann', 1, 1), result(1, 'Ann', 2, 0), result(2, 'Ann', 2, 2), result(5, 'Ann', 3, 2)];
  assert.deepEqual(linesOf(back), [{ client: 1, name: 'Ann', lesson: 'l', steps: 3, points: 5, of: 6 }]);
  const two = [result(1, 'Ann', 1, 1), result(2, 'Ann', 1, 2), result(1, 'Ann', 2, 1), result(2, 'Ann', 2, 2)];
  assert.deepEqual(
    linesOf(two).map(({ client, steps, points }) => [client, steps, points]),
    [
      [1, 2, 2],
      [2, 2, 4],
    ],
  );
  assert.equal(linesOf([result(1, '', 1, 1), result(2, '', 1, 1)]).length, 2, 'no name is nobody');
});

test("students' answers to questions are kept as results, the last of each", () => {
  const answers = new Answers();
  const ask = (id: string, said: [number, Member['role'], string | null][], results: ClassResult[] = []) => {
    const members = said.map(([client, role, answer]): Member => {
      return { id: client, name: `n${client}`, role, hand: -1, hand_up: false, answer };
    });
    const question = id === '' ? null : { id, text: `=${id}?`, options: ['a', 'b'] };
    answers.take({
      frozen: false,
      look: null,
      question,
      lesson: null,
      students: 2,
      you: { hand_up: false },
      members,
      results,
    });
  };
  ask('q', [
    [1, 'student', 'a'],
    [2, 'student', null],
    [3, 'instructor', 'a'],
  ]);
  const before = answers.newest;
  ask('q', [[1, 'student', 'a']]);
  assert.equal(answers.newest, before);
  ask('q', [
    [1, 'student', 'b'],
    [2, 'student', 'a'],
  ]);
  ask('', [
    [1, 'student', null],
    [2, 'student', null],
  ]);
  ask(
    'r',
    [
      [1, 'student', 'b'],
      [2, 'student', null],
    ],
    [result(1, 'n1', 1, 1)],
  );
  const rows = resultsCsv(answers.among([])).split('\r\n').slice(1, -1);
  assert.deepEqual(rows, ["1,n1,question,0,b,0,0,'=q?", "2,n2,question,0,a,0,0,'=q?", "1,n1,question,0,b,0,0,'=r?"]);
});

test('only so many results are kept', () => {
  const results = Array.from({ length: MOST_RESULTS + 7 }, (_, i) => ({ number: i + 1 }));
  const kept = readClassState({ results }, 1, null).results ?? [];
  assert.deepEqual([kept.length, kept[0]?.number], [MOST_RESULTS, 8]);
});

test('a refusal is told in own words where its kind is known', () => {
  const refused = { code: 'refused', text: 'no such thing' } as const;
  assert.deepEqual(sentenceOf({ ...refused, value: 0 }), ['web.refused', 'no such thing']);
  assert.deepEqual(sentenceOf({ ...refused, value: 9 }), ['web.refused', 'no such thing']);
  assert.deepEqual(sentenceOf({ ...refused, value: 2 }), ['web.refused.question']);
  assert.deepEqual(sentenceOf({ code: 'stop', value: 0, text: '' }), ['web.net.stopped']);
});

const POSE: CameraPose = { eye: [0.123456, -1, 2], target: [0, 0, 0.3] };

test('a look comes out as it went in', () => {
  const look = { ...plainLook(), parts: { ulna: 'hidden' as const }, only: ['ulna', 'radius'], labels: true };
  const shared = unpackLook(JSON.parse(JSON.stringify(packLook(POSE, look, 'radius'))));
  assert.deepEqual(shared, { camera: { ...POSE, eye: [0.1235, -1, 2] }, view: look, selected: 'radius' });
});

test('a look that is too long for the server keeps its camera', () => {
  const only = Array.from({ length: 300 }, (_, i) => `a_rather_long_muscle_${i}`);
  const sent = packLook(POSE, { ...plainLook(), only }, null);
  assert.ok(JSON.stringify(sent).length < 300);
  assert.ok(unpackLook(sent));
});

test('what is no look is none, and nonsense in it is left out', () => {
  const camera = { eye: [0, 1, 2], target: [0, 0, 0] };
  const nothing = [null, 7, 'x', [], {}, { camera: { eye: [0, 1], target: [0, 0, 0] } }, { camera: [0] }];
  for (const sent of nothing) assert.equal(unpackLook(sent), null);
  assert.equal(unpackLook({ camera: { ...camera, eye: [0, NaN, 1] } }), null);
  assert.equal(unpackLook({ camera: { ...camera, eye: [0, 1e9, 1] } }), null);
  const view = {
    colour: 'red',
    labels: 'yes',
    only: [7],
    layers: { deep: 2 },
    parts: { ulna: 'gone', radius: 'faded' },
  };
  assert.deepEqual(unpackLook({ camera, view }), { camera, view: { parts: { radius: 'faded' } }, selected: null });
});

test("the server's words on the class are read, older results kept, and nonsense is an empty class", () => {
  const member = { id: 3, name: 'Zoë', role: 'student', hand: 0, answer: null };
  const said = (results: object[]) => ({ frozen: true, students: 1, hands_up: [3], members: [member], results });
  const before = readClassState(
    said([
      { number: 1, answer: 'a' },
      { number: 2, answer: 'b' },
    ]),
    3,
    null,
  );
  assert.deepEqual(before.members, [{ ...member, hand_up: true }]);
  assert.deepEqual([before.frozen, before.you.hand_up, before.question, before.look], [true, true, null, null]);
  const after = readClassState(
    said([
      { number: 2, answer: 'b' },
      { number: 3, answer: 'c' },
    ]),
    4,
    before,
  );
  assert.deepEqual(
    after.results?.map(({ answer }) => answer),
    ['a', 'b', 'c'],
  );
  assert.equal(after.you.hand_up, false);
  const anew = readClassState(said([{ number: 1, answer: 'd' }]), 4, after);
  assert.deepEqual(
    anew.results?.map(({ answer }) => answer),
    ['d'],
    'the server began anew',
  );
  for (const nonsense of [null, 7, [], { question: { id: 1 }, members: 3, hands_up: {}, lesson: 2 }]) {
    const { frozen, question, lesson, students, you } = readClassState(nonsense, 1, null);
    assert.deepEqual([frozen, question, lesson, students, you.hand_up], [false, null, null, 0, false]);
  }
});

test('what is typed fits the server: one line, in whole letters', () => {
  assert.equal(shortLine(' a\nb\u0000c ', 100), 'a b c');
  assert.equal(shortLine('ääää', 5), 'ää');
  assert.equal(shortLine('😀😀', 7), '😀');
});

test('a question has a text and two to six different options', () => {
  assert.equal(makeQuestion('1', ' ', ['a', 'b']), null);
  assert.equal(makeQuestion('1', 'Why?', ['a', ' a ', '']), null);
  assert.deepEqual(makeQuestion('1', ' Why? ', ['b', '', ' a ']), { id: '1', text: 'Why?', options: ['b', 'a'] });
  assert.equal(makeQuestion('1', 'Why?', [...'abcdefgh'])?.options.length, MOST_OPTIONS);
});

test('answers are counted by option; others are none', () => {
  const member = (answer: string | null): Member => {
    return { id: 1, name: 'n', role: 'student', hand: -1, hand_up: false, answer };
  };
  const question = { id: '1', text: 'Why?', options: ['a', 'b'] };
  assert.deepEqual(countAnswers(question, ['a', 'a', 'b', null, 'c', 'a'].map(member)), [
    { option: 'a', students: 3, share: 0.75 },
    { option: 'b', students: 1, share: 0.25 },
  ]);
  assert.deepEqual(
    countAnswers(question, []).map(({ share }) => share),
    [0, 0],
  );
});

test('a throttle lets the first and the last through, and no more than its share', () => {
  const passed: number[] = [];
  let pass_time = () => {};
  const later = (wake: () => void) => {
    pass_time = wake;
    return () => (pass_time = () => {});
  };
  const throttle = new Throttle<number>(100, (value) => passed.push(value), later);
  for (let i = 0; i < 5; ++i) throttle.push(i);
  assert.deepEqual(passed, [0]);
  pass_time();
  assert.deepEqual(passed, [0, 4]);
  throttle.push(5);
  assert.deepEqual(passed, [0, 4], 'the last one was just now');
  throttle.stop();
  pass_time();
  assert.deepEqual(passed, [0, 4]);
  throttle.push(6);
  assert.deepEqual(passed, [0, 4, 6]);
});
