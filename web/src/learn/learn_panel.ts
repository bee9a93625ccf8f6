/** The panel of lessons: the list, the step that is being played, what came of it. */

import { el, refill } from '../app/dom';
import type { App } from '../app/state';
import type { Lesson, Step } from './lesson';
import { mostPoints } from './lesson';
import { pointsOf } from './lesson_run';
import { anatomyOf, LessonSession } from './lesson_session';
import { readLessons, type ListedLesson } from './read_lesson';
import { ResultSender } from './result_sender';
import { taskViews } from './task_view';
import { paragraph, pointsText, shareBar, textButton, type Live } from './widgets';

export class LearnPanel {
  readonly element = el('div', { class: 'learn' });
  private readonly lessons: ListedLesson[];
  private readonly sender: ResultSender;
  private session: LessonSession | null = null;
  private live: Live[] = [];
  private drawn = ''; // what the panel was built for

  constructor(private readonly app: App) {
    this.lessons = readLessons(app.lessons, anatomyOf(app));
    this.sender = new ResultSender(app);
    app.on('language', () => this.rebuild());
    app.on('me', () => this.rebuild());
    this.draw();
  }

  get playing(): string | null {
    return this.session?.run.lesson.key ?? null;
  }

  /** Begins a lesson by its key; one that is played already goes on. False where there is none that works. */
  open(key: string): boolean {
    const lesson = this.lessons.find((listed) => listed.lesson?.key === key)?.lesson;
    if (!lesson) return false;
    if (this.playing !== key) this.begin(lesson);
    return true;
  }

  close(): void {
    this.session?.close();
    this.session = null;
    this.draw();
  }

  private begin(lesson: Lesson): void {
    this.session?.close();
    this.session = new LessonSession(this.app, lesson, () => this.draw());
    this.rebuild();
    this.app.reveal('learn');
  }

  private rebuild(): void {
    this.drawn = '';
    this.draw();
  }

  /** Builds anew only what is another step or state, so that a text that is being typed stays. */
  private draw(): void {
    const run = this.session?.run;
    if (this.session && run) this.sender.report(run);
    const { done, feedback, attempts, hints, predicted } = run?.state ?? {};
    const wanted = JSON.stringify([
      this.playing,
      run?.index,
      run?.finished,
      done,
      feedback,
      attempts,
      hints,
      predicted,
    ]);
    if (wanted !== this.drawn) {
      this.drawn = wanted;
      this.build();
    }
    for (const { update } of this.live) update();
  }

  private build(): void {
    this.live = [];
    if (!this.session) refill(this.element, ...this.list());
    else refill(this.element, ...(this.session.run.finished ? this.results(this.session) : this.step(this.session)));
  }

  private list(): HTMLElement[] {
    const { t } = this.words();
    if (this.lessons.length === 0) return [el('p', { text: t('web.learn.none') })];
    return [el('p', { text: t('learn.intro') }), ...this.lessons.map((listed) => this.listed(listed))];
  }

  private listed({ lesson, complaint, name }: ListedLesson): HTMLElement {
    const { t } = this.words();
    const title = el('h3', { text: name });
    if (!lesson)
      return el('section', { class: 'lesson broken' }, title, el('p', { text: t('learn.broken', complaint) }));
    const about = t('web.learn.about', lesson.steps.length, pointsText(mostPoints(lesson)));
    const start = textButton(t('learn.start'), 'primary', () => this.begin(lesson));
    start.setAttribute('aria-label', `${t('learn.start')}: ${name}`);
    return el('section', { class: 'lesson', lang: lesson.language }, title, el('p', { text: about }), start);
  }

  private step(session: LessonSession): HTMLElement[] {
    const { t } = this.words();
    const { run } = session;
    const { lesson, step, state, index } = run;
    const count = lesson.steps.length;
    const progress = shareBar(() => ({
      share: (index + 1) / count,
      text: t('learn.progress', index + 1, count, pointsText(run.score), pointsText(mostPoints(lesson))),
    }));
    const hints = step.hints.slice(0, state.hints).map((hint) => paragraph('hint', () => t('learn.hint_text', hint)));
    const tasks = [paragraph('quiet small', () => this.wantedOfTeacher(step)), ...taskViews(this.app, session)];
    this.live = [progress, ...tasks, ...hints];
    const text = el('div', { lang: lesson.language }, el('h3', { text: step.title }), el('p', { text: step.text }));
    const body = el('div', { class: 'step' }, text, ...[...tasks, ...hints].map(({ element }) => element));
    return [el('h2', { text: lesson.title, lang: lesson.language }), progress.element, body, this.buttons(session)];
  }

  /** What a step sets of the scene a student's page cannot: where it is not so, the teacher has to know. */
  private wantedOfTeacher({ set, task }: Step): string {
    const { me, inForce, texts } = this.app;
    if (me.role === 'instructor' || task.kind === 'stiffen' || set.common === undefined || !inForce) return '';
    const isSo = Math.abs(inForce.common - set.common) < 0.02;
    return isSo ? '' : texts.t('web.learn.set_by_teacher', 100 * set.common);
  }

  /** Each has its place whatever the step, so that a second click never meets another one. */
  private buttons(session: LessonSession): HTMLElement {
    const { t } = this.words();
    const { run } = session;
    const { step, state } = run;
    const back = textButton(t('learn.back'), 'plain', () => session.act((it) => it.goBack()));
    back.disabled = run.index === 0;
    const hint = textButton(t('learn.hint'), 'plain', () => session.act((it) => it.askHint()));
    hint.disabled = state.done || state.hints >= step.hints.length;
    hint.title = t('learn.hint.tip');
    const end = textButton(t('learn.close'), 'plain', () => this.close());
    end.title = t('learn.close.tip');
    const goesOn = state.done || step.task.kind === 'read';
    const next = textButton(t(goesOn ? 'learn.next' : 'learn.leave_out'), goesOn ? 'primary' : 'plain', () =>
      session.act((it) => it.goOn()),
    );
    if (!goesOn) next.title = t('learn.leave_out.tip');
    return el('div', { class: 'step-buttons' }, back, next, hint, end);
  }

  private results(session: LessonSession): HTMLElement[] {
    const { t } = this.words();
    const { run } = session;
    const { lesson } = run;
    const scored = lesson.steps.map((step, i) => ({ step, state: run.states[i] }));
    const lines = scored.flatMap(({ step, state }) => {
      if (!state || step.task.kind === 'read') return [];
      return [
        el('li', {
          text: t('learn.step_points', step.title, pointsText(pointsOf(step, state)), pointsText(step.points)),
        }),
      ];
    });
    const sum = t('learn.finished', pointsText(run.score), pointsText(mostPoints(lesson)));
    const back = textButton(t('learn.back'), 'plain', () => session.act((it) => it.goBack()));
    const end = textButton(t('learn.close'), 'primary', () => this.close());
    return [
      el('h2', { text: lesson.title, lang: lesson.language }),
      el('p', { class: 'sum', role: 'status', text: sum }),
      el('ul', { class: 'points', lang: lesson.language }, ...lines),
      el('div', { class: 'step-buttons' }, back, end),
    ];
  }

  private words(): Pick<App['texts'], 't'> {
    return { t: (key, ...values) => this.app.texts.t(key, ...values) };
  }
}
