/** Where a student stands in one step, recognised from what is seen of the scene. Times of holding are simulated. */

import { keyOf, samePart, type Anatomy, type Motion, type Part, type Task, type TaskOf } from './lesson';

const TOUCH_S = 0.3; // a tool that only brushes past has not touched
const SETTLE_S = 0.5; // until a joint rests after what a step has set
const LONGEST_PICTURE_S = 0.2; // a pause or a jump of the clock is no time that the student held

/** A hand of the scene, as far as lessons care; -1: none. */
export interface ToolSeen {
  touches: boolean;
  muscle: number; // touched
  body: number; // whose bone is touched
  line: number; // muscle whose line is in hand
  force_N: readonly [number, number, number];
}

export interface JointSeen {
  angle_rad: number; // positive flexed
  stiffness_Nm_rad: number;
  passive_Nm_rad: number;
  muscles: readonly { moment_arm_m: number }[];
}

/** What a lesson sees of scene and student in one picture. */
export interface Observation {
  time_s: number; // simulated
  clock_s: number; // of the wall, rising
  selected: Part | null; // what was clicked last
  tools: readonly ToolSeen[];
  joints: readonly JointSeen[];
  bodyOfBone: (bone: number) => number;
}

export type Feedback = 'none' | 'right' | 'wrong' | 'touchFirst' | 'pullNow';

export interface TaskState {
  done: boolean; // answered for good, or left out
  right: boolean; // and rightly in the end
  attempts: number; // answers given
  wrong: number; // of these
  hints: number; // asked for
  seconds: number;
  answer: string; // the last one: a key, a word or a number
  feedback: Feedback;

  // As of the last picture, for the student to see.
  touched: boolean; // the part asked for, long enough, now or before
  held_s: number; // so long now, of the time that is asked for
  force_N: number; // on the hand
  predicted: Motion | null;
  moment_arm_m: number; // of the muscle about the joint, positive flexes
  turned_rad: number; // since the line was taken, positive flexed; or since the step began
  stiffness_Nm_rad: number;
  lowest_Nm_rad: number;

  // To detect what is new.
  begun: boolean;
  frame_s: number; // simulated time of the last picture
  age_s: number; // simulated, since the step began
  start_rad: number; // of the joint
  pulling: boolean; // the line is in hand
  selectedBefore: Part | null;
}

export function freshState(): TaskState {
  return {
    ...{ done: false, right: false, attempts: 0, wrong: 0, hints: 0, seconds: 0, answer: '', feedback: 'none' },
    ...{ touched: false, held_s: 0, force_N: 0, predicted: null, moment_arm_m: 0, turned_rad: 0 },
    ...{ stiffness_Nm_rad: 0, lowest_Nm_rad: 0 },
    ...{ begun: false, frame_s: 0, age_s: 0, start_rad: 0, pulling: false, selectedBefore: null },
  };
}

/** Counts an answer: what was clicked, chosen or typed, as the results list it. */
export function countAnswer(right: boolean, answer: string, state: TaskState): void {
  ++state.attempts;
  state.answer = answer;
  state.feedback = right ? 'right' : 'wrong';
  if (right) state.done = state.right = true;
  else ++state.wrong;
}

/** Two decimals are what an instrument on a screen shows. */
export function rounded(value: number): string {
  return String(Math.round(value * 100) / 100);
}

interface Look {
  seen: Observation;
  anatomy: Anatomy;
  dt_s: number; // simulated, since the last picture
}

/** Time counts back twice as fast as it ran, so that a short slip does not cost all of it. */
function hold(holds: boolean, dt_s: number, state: TaskState): void {
  state.held_s = holds ? state.held_s + dt_s : Math.max(0, state.held_s - 2 * dt_s);
}

/** The tool that touches the part. Bones of one body cannot be distinguished by touch: they count as one. */
function toolOn(part: Part, seen: Observation): ToolSeen | null {
  const body = part.kind === 'bone' ? seen.bodyOfBone(part.index) : -1;
  const isOn = (tool: ToolSeen) =>
    tool.touches && (part.kind === 'muscle' ? tool.muscle === part.index : body >= 0 && tool.body === body);
  return seen.tools.find(isOn) ?? null;
}

function feel(part: Part, look: Look, state: TaskState): void {
  state.held_s = toolOn(part, look.seen) ? state.held_s + look.dt_s : 0;
  state.touched = state.touched || state.held_s >= TOUCH_S;
}

function watchFind(task: TaskOf<'find'>, { seen, anatomy }: Look, state: TaskState): void {
  const now = seen.selected;
  const isNew = now !== null && !samePart(now, state.selectedBefore);
  state.selectedBefore = now;
  if (isNew) countAnswer(samePart(now, task.part), keyOf(anatomy, now), state);
}

function watchTouch(task: TaskOf<'touch'>, look: Look, state: TaskState): void {
  feel(task.part, look, state);
  if (state.touched) countAnswer(true, keyOf(look.anatomy, task.part), state);
}

function watchPress(task: TaskOf<'press'>, look: Look, state: TaskState): void {
  const tool = toolOn({ kind: 'muscle', index: task.muscle }, look.seen);
  state.force_N = tool ? Math.hypot(...tool.force_N) : 0;
  hold(state.force_N >= task.low_N && state.force_N <= task.high_N, look.dt_s, state);
  if (state.held_s >= task.hold_s) countAnswer(true, rounded(state.force_N), state);
}

function watchPredict(task: TaskOf<'predict'>, { seen }: Look, state: TaskState): void {
  const joint = seen.joints[task.joint];
  const muscle = joint?.muscles[task.muscle];
  if (!joint || !muscle) return;
  state.moment_arm_m = muscle.moment_arm_m;
  if (!state.predicted) return;
  const pulls = seen.tools.some((tool) => tool.line === task.muscle);
  if (pulls && !state.pulling) state.start_rad = joint.angle_rad;
  state.pulling = pulls;
  state.turned_rad = pulls ? joint.angle_rad - state.start_rad : 0;
  const sign = task.motion === 'flexion' ? 1 : -1;
  if (sign * state.turned_rad < task.turn_rad) return;
  countAnswer(state.predicted === task.motion, state.predicted, state);
  state.done = true; // seen is seen: there is no second guess
}

function watchStiffen(task: TaskOf<'stiffen'>, { seen, dt_s }: Look, state: TaskState): void {
  const joint = seen.joints[task.joint];
  if (!joint) return;
  state.stiffness_Nm_rad = joint.stiffness_Nm_rad;
  if (state.age_s < SETTLE_S) {
    state.start_rad = joint.angle_rad;
    return;
  }
  // A joint that is barely or not at all stable is compared with what it has without muscles.
  const lowest = Math.max(state.stiffness_Nm_rad, joint.passive_Nm_rad, 1e-6);
  state.lowest_Nm_rad = state.lowest_Nm_rad > 0 ? Math.min(state.lowest_Nm_rad, lowest) : lowest;
  state.turned_rad = joint.angle_rad - state.start_rad;
  const stiff = state.stiffness_Nm_rad >= task.factor * state.lowest_Nm_rad;
  hold(stiff && Math.abs(state.turned_rad) <= task.within_rad, dt_s, state);
  if (state.held_s >= task.hold_s) countAnswer(true, rounded(state.stiffness_Nm_rad), state);
}

function watchTask(task: Task, look: Look, state: TaskState): void {
  if (task.kind === 'find') watchFind(task, look, state);
  else if (task.kind === 'touch') watchTouch(task, look, state);
  else if (task.kind === 'press') watchPress(task, look, state);
  else if (task.kind === 'predict') watchPredict(task, look, state);
  else if (task.kind === 'stiffen') watchStiffen(task, look, state);
  else if (task.kind === 'identify') feel(task.part, look, state);
}

/** Follows what the student does; sets `done` and `right` when the task is fulfilled. Not for one that is done. */
export function watch(task: Task, seen: Observation, anatomy: Anatomy, state: TaskState): void {
  if (!state.begun) {
    state.begun = true;
    state.frame_s = seen.time_s;
    state.selectedBefore = seen.selected;
  }
  const dt_s = Math.min(LONGEST_PICTURE_S, Math.max(0, seen.time_s - state.frame_s));
  state.frame_s = seen.time_s;
  state.age_s += dt_s;
  watchTask(task, { seen, anatomy, dt_s }, state);
}
