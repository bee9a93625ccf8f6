/** Sends what came of each step once, and again after a break what could not be sent. */

import type { App } from '../app/state';
import { shortLine } from '../text/short_line';
import { pointsOf, type LessonRun } from './lesson_run';

const LONGEST_ANSWER = 100; // bytes, as the server takes them

export class ResultSender {
  private readonly reported = new WeakMap<LessonRun, Set<number>>();
  private waiting: object[] = [];

  constructor(private readonly app: App) {
    app.on('connection', ({ state }) => {
      if (state === 'joined') this.flush();
    });
  }

  /** Of the steps that are done now and were not before. Only students' results are wanted. */
  report(run: LessonRun): void {
    if (this.app.me.role !== 'student') return;
    const reported = this.reported.get(run) ?? new Set<number>();
    this.reported.set(run, reported);
    run.lesson.steps.forEach((step, index) => {
      const state = run.states[index];
      if (!state?.done || step.task.kind === 'read' || reported.has(index)) return;
      reported.add(index);
      const { points: of } = step;
      const answer = shortLine(state.answer, LONGEST_ANSWER);
      const { key: lesson } = run.lesson;
      this.waiting.push({ do: 'class_result', lesson, step: index + 1, answer, points: pointsOf(step, state), of });
    });
    this.flush();
  }

  private flush(): void {
    if (this.app.connection.state !== 'joined') return;
    for (const result of this.waiting.splice(0)) this.app.send(result);
  }
}
