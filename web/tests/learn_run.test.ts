import assert from 'node:assert/strict';
import { test } from 'node:test';
import type { Part } from '../src/learn/lesson';
import { LessonRun, pointsOf } from '../src/learn/lesson_run';
import { namesPart } from '../src/learn/names_part';
import { readLesson } from '../src/learn/read_lesson';
import { freshState, type JointSeen, type Observation, type ToolSeen } from '../src/learn/task_state';
import { bodyOfBone, elbow, lessonOf } from './elbow';

// As tests/learn/lesson_run_test.cpp has them: the page judges as the window does.

const BICEPS = 0;
const BRACHIALIS = 1;
const ELBOW = 1;

type Writable<T> = { -readonly [K in keyof T]: T[K] };

const muscle = (index: number): Part => ({ kind: 'muscle', index });
const bone = (index: number): Part => ({ kind: 'bone', index });
const near = (value: number, wanted: number, within = 1e-9) =>
  assert.ok(Math.abs(value - wanted) <= within, `${value}`);

/** A scene as the simulation would publish it, and the student before it. */
class Lesson {
  readonly run: LessonRun;
  readonly tool: Writable<ToolSeen> = { touches: false, muscle: -1, body: -1, line: -1, force_N: [0, 0, 0] };
  readonly arms = elbow.muscles.map(() => ({ moment_arm_m: 0 }));
  readonly joint: Writable<JointSeen> = { angle_rad: 0, stiffness_Nm_rad: 0, passive_Nm_rad: 0, muscles: this.arms };
  selected: Part | null = null;
  time_s = 0;
  clock_s = 100;

  constructor(members: object) {
    this.run = new LessonRun(readLesson(lessonOf(members), elbow), elbow);
  }

  get state() {
    return this.run.state;
  }

  seen(): Observation {
    const rest = { ...this.joint, angle_rad: 0 };
    const joints = elbow.joints.map((_, index) => (index === ELBOW ? this.joint : rest));
    const { time_s, clock_s, selected } = this;
    return { time_s, clock_s, selected, tools: [this.tool], joints, bodyOfBone };
  }

  /** Pictures of 10 ms. */
  pass(seconds: number): void {
    for (let i = 0; i < Math.round(100 * seconds); ++i) {
      this.time_s += 0.01;
      this.clock_s += 0.01;
      this.run.observe(this.seen());
    }
  }

  touch(index: number, force_N = 0): void {
    this.tool.touches = index >= 0;
    this.tool.muscle = index;
    this.tool.force_N = [0, 0.6 * force_N, -0.8 * force_N];
  }
}

test('find takes clicks and tells wrong ones', () => {
  const c = new Lesson({ task: { kind: 'find', part: 'brachialis' }, points: 4 });
  c.selected = muscle(BRACHIALIS); // from before the lesson: no answer
  c.pass(0.5);
  assert.equal(c.state.attempts, 0);
  c.selected = muscle(BICEPS);
  c.pass(0.5);
  assert.deepEqual([c.state.feedback, c.state.answer, c.state.attempts], ['wrong', 'biceps_brachii', 1]);
  c.selected = null;
  c.pass(0.1);
  assert.equal(c.state.attempts, 1);
  c.selected = muscle(BRACHIALIS);
  c.pass(0.1);
  assert.ok(c.state.right);
  assert.equal(c.run.score, 2);
  near(c.state.seconds, 1.09, 0.011);
});

test('hints take a quarter each, and none is left after the last', () => {
  const c = new Lesson({ task: { kind: 'find', part: 'ulna' }, hints: ['a', 'b'] });
  for (let i = 0; i < 5; ++i) c.run.askHint();
  assert.equal(c.state.hints, 2);
  c.pass(0.1);
  c.selected = bone(3);
  c.pass(0.1);
  assert.equal(c.run.score, 0.5);
  c.run.askHint();
  assert.equal(c.run.score, 0.5);
});

test('points never go below none', () => {
  const { step } = new Lesson({ task: { kind: 'find', part: 'ulna' }, points: 2 }).run;
  assert.equal(pointsOf(step, { ...freshState(), right: true, wrong: 3, hints: 2 }), 0);
  assert.equal(pointsOf(step, freshState()), 0);
});

test('touch wants the muscle itself for a moment', () => {
  const c = new Lesson({ task: { kind: 'touch', part: 'brachialis' } });
  c.touch(BICEPS);
  c.pass(1);
  c.touch(BRACHIALIS);
  c.pass(0.2);
  c.touch(-1);
  c.pass(0.1);
  assert.ok(!c.state.done);
  c.touch(BRACHIALIS);
  c.pass(0.35);
  assert.ok(c.state.right);
});

test('touch of a bone is that of its body', () => {
  const c = new Lesson({ task: { kind: 'touch', part: 'ulna' } });
  c.tool.touches = true;
  c.tool.body = bodyOfBone(1);
  c.pass(0.5);
  assert.ok(!c.state.done);
  c.tool.body = bodyOfBone(2); // the radius, which moves with it
  c.pass(0.5);
  assert.ok(c.state.right);
});

test('press wants the force in the band for the time', () => {
  const c = new Lesson({ task: { kind: 'press', muscle: 'brachialis', band_N: [0.5, 1], hold_s: 1 } });
  c.touch(BRACHIALIS, 1.5);
  c.pass(2);
  near(c.state.force_N, 1.5);
  assert.equal(c.state.held_s, 0);
  c.touch(BRACHIALIS, 0.75);
  c.pass(0.8);
  near(c.state.held_s, 0.8);
  c.touch(BRACHIALIS, 0.2);
  c.pass(0.1);
  near(c.state.held_s, 0.6); // a slip counts back twice
  c.touch(BICEPS, 0.75);
  c.pass(0.1);
  c.touch(BRACHIALIS, 0.75);
  c.pass(0.55);
  assert.ok(!c.state.done);
  c.pass(0.1);
  assert.ok(c.state.right);
  assert.equal(c.state.answer, '0.75');
});

test('a paused scene holds nothing', () => {
  const c = new Lesson({ task: { kind: 'press', muscle: 'brachialis', band_N: [0.5, 1] } });
  c.touch(BRACHIALIS, 0.75);
  for (let i = 0; i < 1000; ++i) c.run.observe(c.seen());
  assert.equal(c.state.held_s, 0);
});

test('a prediction is judged by the pull that follows', () => {
  for (const guess of ['flexion', 'extension'] as const) {
    const c = new Lesson({ task: { kind: 'predict', muscle: 'biceps_brachii', joint: 'elbow', motion: 'flexion' } });
    const turn = (angle_rad: number) => {
      c.joint.angle_rad = angle_rad;
      c.pass(0.1);
    };
    c.arms[BICEPS] = { moment_arm_m: 0.0113 };
    c.tool.line = BICEPS; // pulling before predicting shows nothing
    turn(0.2);
    turn(0.3);
    assert.ok(!c.state.done);
    c.tool.line = -1;
    c.run.predict(guess);
    c.run.predict('flexion'); // no second thoughts
    assert.equal(c.state.feedback, 'pullNow');
    c.pass(0.1);
    c.tool.line = BICEPS;
    c.pass(0.1);
    turn(0.303);
    assert.ok(!c.state.done, 'less than a fifth of a degree');
    turn(0.31);
    assert.ok(c.state.done);
    assert.equal(c.state.right, guess === 'flexion');
    assert.equal(c.run.score, guess === 'flexion' ? 1 : 0.5);
    assert.equal(c.state.moment_arm_m, 0.0113);
  }
});

test('stiffen wants stiffness at the same angle', () => {
  const c = new Lesson({ task: { kind: 'stiffen', joint: 'elbow', factor: 3, within_rad: 0.02, hold_s: 1 } });
  const be = (stiffness_Nm_rad: number, angle_rad: number, seconds: number) => {
    Object.assign(c.joint, { stiffness_Nm_rad, angle_rad });
    c.pass(seconds);
  };
  be(1.5, 0.1, 1);
  assert.equal(c.state.lowest_Nm_rad, 1.5);
  be(4.6, 0.15, 2); // one side won
  assert.ok(!c.state.done);
  be(4.4, 0.11, 2);
  assert.ok(!c.state.done);
  be(4.6, 0.11, 1.1);
  assert.ok(c.state.right);
  assert.equal(c.state.answer, '4.6');
});

test('an unstable joint is compared with its own spring', () => {
  const c = new Lesson({ task: { kind: 'stiffen', joint: 'elbow', factor: 2 } });
  Object.assign(c.joint, { stiffness_Nm_rad: -6.5, passive_Nm_rad: 0.1 });
  c.pass(1);
  assert.equal(c.state.lowest_Nm_rad, 0.1);
});

test('identify wants the touch before the name', () => {
  const c = new Lesson({ task: { kind: 'identify', part: 'brachialis', options: ['biceps_brachii', 'brachialis'] } });
  c.run.choose(1);
  assert.deepEqual([c.state.feedback, c.state.attempts], ['touchFirst', 0]);
  c.touch(BRACHIALIS);
  c.pass(0.5);
  assert.ok(c.state.touched);
  c.run.choose(7);
  assert.equal(c.state.attempts, 0);
  c.run.choose(0);
  assert.equal(c.state.feedback, 'wrong');
  c.run.choose(1);
  assert.ok(c.state.right);
  assert.equal(c.run.score, 0.5);
});

test('names are chosen or typed', () => {
  const chosen = new Lesson({ task: { kind: 'name', part: 'ulna', options: ['radius', 'ulna'] } });
  chosen.run.choose(1);
  assert.ok(chosen.state.right);
  const typed = new Lesson({ task: { kind: 'name', part: 'biceps_brachii' } });
  typed.run.type('brachialis');
  typed.run.type('M. biceps brachii');
  assert.ok(typed.state.right);
  assert.equal(typed.state.wrong, 1);
});

test('left out steps earn nothing, and going back keeps answers', () => {
  const name = { kind: 'name', part: 'ulna', options: ['radius', 'ulna'] };
  const steps = [
    { title: 'a', text: 'x' },
    { title: 'b', text: 'x', task: name },
    { title: 'c', text: 'x', task: { kind: 'find', part: 'ulna' } },
  ];
  const run = new LessonRun(readLesson({ schema: 1, key: 'l', title: 'T', scene: 'elbow', steps }, elbow), elbow);
  run.goBack();
  assert.equal(run.index, 0);
  run.goOn();
  run.choose(1);
  run.goOn();
  run.goOn();
  assert.ok(run.finished);
  assert.equal(run.score, 1);
  assert.ok(!run.states[2]?.right);
  run.goBack();
  assert.ok(!run.finished);
  run.goBack();
  assert.equal(run.index, 1);
  run.choose(0);
  assert.ok(run.state.right);
});

const names = (text: string, key: string, accept: string[] = []) =>
  namesPart(text, muscle(elbow.muscles.findIndex((part) => part.key === key)), elbow, accept);
const namesUlna = (text: string) => namesPart(text, bone(3), elbow);

test('names are Latin, English, keys and the short forms of books', () => {
  assert.ok(names('Biceps brachii', 'biceps_brachii'));
  assert.ok(names('  m. BICEPS   brachii ', 'biceps_brachii'));
  assert.ok(names('musculus biceps brachii', 'biceps_brachii'));
  assert.ok(names('biceps_brachii', 'biceps_brachii'));
  assert.ok(names('Triceps brachii, caput longum', 'triceps_brachii_long'));
  assert.ok(names('long head of triceps', 'triceps_brachii_long', ['long head of triceps']));
  assert.ok(namesUlna('Ulna'));
  assert.ok(namesUlna('Elbow bone'));
});

test('a slip is forgiven in a long word only', () => {
  for (const slip of ['bicepts brachii', 'biceps brachi', 'bicesp brachii']) assert.ok(names(slip, 'biceps_brachii'));
  assert.ok(!names('bbeps brachii', 'biceps_brachii'), 'two letters of one word');
  assert.ok(names('brachalis', 'brachialis'));
  assert.ok(!names('bicep', 'biceps_brachii'));
  assert.ok(!namesUlna('una'));
});

test('other muscles and nothing are wrong', () => {
  assert.ok(!names('', 'brachialis'));
  assert.ok(!names(' . ', 'brachialis'));
  assert.ok(!names('brachialis', 'biceps_brachii'));
  assert.ok(!names('triceps brachii', 'biceps_brachii'));
  assert.ok(!names('triceps brachii, lateral head', 'triceps_brachii_medial'));
  assert.ok(!names('b'.repeat(1000000), 'biceps_brachii'));
});
