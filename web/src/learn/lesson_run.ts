/**
 * A student's way through a lesson: which step, what was answered, how many points. Fed with the readings, five times a
 * second.
 */

import { keyOf, samePart, type Anatomy, type Lesson, type Motion, type Part, type Step } from './lesson';
import { namesPart } from './names_part';
import { countAnswer, freshState, watch, type Observation, type TaskState } from './task_state';

const LONGEST_PAUSE_S = 5; // between readings; a longer one is a machine that slept

/**
 * Points of a step: all of them for a right answer without help; each hint takes a quarter, each wrong answer half,
 * never below none. A wrong prediction that the pull has put right still earns the half.
 */
export function pointsOf(step: Step, state: TaskState): number {
  const seen = step.task.kind === 'predict' && state.attempts > 0;
  if (!state.right && !seen) return 0;
  return step.points * Math.max(0, 1 - 0.25 * state.hints - 0.5 * state.wrong);
}

export class LessonRun {
  readonly states: readonly TaskState[]; // as the steps
  private place = 0;
  private ended = false;
  private clock_s: number | null = null;

  constructor(
    readonly lesson: Lesson,
    private readonly anatomy: Anatomy,
  ) {
    this.states = lesson.steps.map(freshState);
  }

  get index(): number {
    return this.place;
  }

  get finished(): boolean {
    return this.ended;
  }

  get step(): Step {
    return this.lesson.steps[this.place] as Step; // the place never leaves the list
  }

  get state(): TaskState {
    return this.states[this.place] as TaskState;
  }

  get score(): number {
    return this.lesson.steps.reduce((sum, step, i) => sum + pointsOf(step, this.states[i] as TaskState), 0);
  }

  private get answered(): boolean {
    return this.ended || this.state.done;
  }

  observe(seen: Observation): void {
    const passed_s = this.clock_s === null ? 0 : seen.clock_s - this.clock_s;
    this.clock_s = seen.clock_s;
    if (this.answered) return;
    this.state.seconds += Math.min(LONGEST_PAUSE_S, Math.max(0, passed_s));
    watch(this.step.task, seen, this.anatomy, this.state);
  }

  /** Of name and identify; ignored where the task is of another kind, or done. */
  choose(option: number): void {
    const { task } = this.step;
    if (this.answered || (task.kind !== 'name' && task.kind !== 'identify')) return;
    if (task.kind === 'identify' && !this.state.touched) {
      this.state.feedback = 'touchFirst';
      return;
    }
    const chosen: Part | undefined = task.options[option];
    if (chosen) countAnswer(samePart(chosen, task.part), keyOf(this.anatomy, chosen), this.state);
  }

  type(name: string): void {
    const { task } = this.step;
    if (this.answered || task.kind !== 'name') return;
    countAnswer(namesPart(name, task.part, this.anatomy, task.accept), name, this.state);
  }

  /** Before pulling; there are no second thoughts. */
  predict(motion: Motion): void {
    if (this.answered || this.step.task.kind !== 'predict' || this.state.predicted) return;
    this.state.predicted = motion;
    this.state.feedback = 'pullNow';
  }

  /** Counts one more hint where the step has one left. */
  askHint(): void {
    if (!this.answered && this.state.hints < this.step.hints.length) ++this.state.hints;
  }

  /** To the next step; a task that is not done counts as left out. After the last step the lesson is finished. */
  goOn(): void {
    if (this.ended) return;
    if (this.step.task.kind === 'read') this.state.right = true;
    this.state.done = true;
    if (this.place + 1 < this.states.length) ++this.place;
    else this.ended = true;
  }

  goBack(): void {
    if (this.ended) this.ended = false;
    else if (this.place > 0) --this.place;
  }
}
