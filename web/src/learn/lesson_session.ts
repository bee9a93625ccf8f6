/** A lesson that is being played on this page: its run, fed with what the page sees, and the look of each step. */

import { plainLook, type Look } from '../app/look';
import type { App } from '../app/state';
import { controlsOf, lookOfStep } from './lesson_look';
import { partOfKey, pointerModeFor, type Anatomy, type Lesson } from './lesson';
import { LessonRun } from './lesson_run';
import type { Observation } from './task_state';

export function anatomyOf({ scene }: App): Anatomy {
  const { muscles, bones, joints, co_contraction } = scene;
  return { muscles, bones, joints, hasOpposingMuscles: co_contraction !== null };
}

/** Null until the scene has been read for the first time. Only this page's own hand counts. */
function observationOf(app: App, anatomy: Anatomy): Observation | null {
  const { readings, selection, me } = app;
  if (!readings) return null;
  const own = readings.tools.slice(me.hand, me.hand + 1); // hands that nobody has keep their places in the list
  return {
    time_s: readings.time_s,
    clock_s: performance.now() / 1000,
    selected: selection === null ? null : partOfKey(anatomy, selection),
    tools:
      me.hand < 0
        ? []
        : own.map(({ in_contact: touches, touched_muscle: muscle, touched_body: body, ...tool }) => {
            return { touches, muscle, body, line: tool.line, force_N: tool.force_N };
          }),
    joints: readings.joints,
    bodyOfBone: (bone) => app.bodyOfBone(bone),
  };
}

export class LessonSession {
  readonly anatomy: Anatomy;
  readonly run: LessonRun;
  private readonly before: Look;
  private readonly stops: (() => void)[];
  private shown = -1; // step whose look is on

  constructor(
    private readonly app: App,
    lesson: Lesson,
    private readonly onChange: () => void,
  ) {
    this.anatomy = anatomyOf(app);
    this.run = new LessonRun(lesson, this.anatomy);
    this.before = { ...app.look };
    this.stops = [app.on('readings', () => this.observe()), app.on('selection', () => this.observe())];
    this.showStep();
  }

  /** How a part is called here, also while names are hidden on the limb. */
  nameOf(key: string): string {
    const part = this.app.part(key);
    if (!part) return key;
    return this.before.names === 'latin' ? part.latin : part.english;
  }

  /** Lets the student act on the run, then shows what came of it. */
  act(action: (run: LessonRun) => void): void {
    action(this.run);
    this.showStep();
    this.onChange();
  }

  /** Everything is shown again as it was before the lesson. */
  close(): void {
    for (const stop of this.stops) stop();
    this.endLook();
  }

  private observe(): void {
    const seen = observationOf(this.app, this.anatomy);
    if (!seen) return;
    const wasDone = this.run.state.done;
    this.run.observe(seen);
    if (!wasDone && this.run.state.done) this.unveil();
    this.onChange();
  }

  /** What has been answered may be read. */
  private unveil(): void {
    if (this.app.look.names === 'none') this.app.setLook({ names: this.before.names });
  }

  private showStep(): void {
    const { run, app } = this;
    if (run.finished) {
      this.endLook();
      this.shown = -1;
      return;
    }
    if (run.state.done) this.unveil();
    if (this.shown === run.index) return;
    this.shown = run.index;
    const { step } = run;
    const names = this.before.names === 'none' ? 'english' : this.before.names;
    app.select(null);
    app.setLook(lookOfStep(step, this.anatomy, names));
    app.setMode(pointerModeFor(step.task));
    if (step.view) app.camera.showFrom(step.view);
    if (app.me.role === 'instructor') for (const control of controlsOf(step.set, app.inForce)) app.send(control);
    if (run.state.done) this.unveil();
  }

  private endLook(): void {
    const { names, labels, colour, layers } = this.before;
    this.app.setLook({ ...plainLook(), names, labels, colour, layers });
    this.app.setMode('look');
  }
}
