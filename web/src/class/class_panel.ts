/** The instructor's panel: who is there, freeze, all look here, a question, a lesson for all. */

import { button, el, refill } from '../app/dom';
import type { App, Member, Question } from '../app/state';
import type { Lesson } from '../learn/lesson';
import { anatomyOf } from '../learn/lesson_session';
import { readLessons } from '../learn/read_lesson';
import { Lead } from './lead';
import { membersView } from './members_view';
import { News } from './news';
import { countAnswers } from './question';
import { QuestionEditor } from './question_editor';

export class ClassPanel {
  readonly element: HTMLElement;
  private readonly summary = el('p', { role: 'status' });
  private readonly freeze = button('toggle', () =>
    this.app.send({ do: 'class_freeze', on: !this.app.classState?.frozen }),
  );
  private readonly look = button('toggle', () => this.toggleLook());
  private readonly ask = button('toggle', () => this.askOrClose());
  private readonly answers = el('div', { class: 'counts' });
  private readonly lessons = el('select');
  private readonly members = el('div');
  private readonly lead: Lead;
  private readonly editor: QuestionEditor;
  private readonly offered: readonly Lesson[];
  private readonly news = { lessons: new News(), answers: new News(), members: new News() };

  constructor(private readonly app: App) {
    const { texts } = app;
    this.lead = new Lead(app);
    this.editor = new QuestionEditor(app);
    this.offered = readLessons(app.lessons, anatomyOf(app)).flatMap(({ lesson }) => lesson ?? []);
    this.lessons.addEventListener('change', () => {
      app.send({ do: 'class_lesson', lesson: this.lessons.value || null });
    });
    const lesson = el('label', { class: 'field' }, texts.bind(el('span'), 'web.class.lesson'), this.lessons);
    const buttons = el('div', { class: 'row wrap' }, this.look, this.freeze, this.ask);
    this.element = el('div', { class: 'class' }, this.summary, buttons, this.answers, lesson, this.members);
    app.on('class', () => this.update());
    app.on('language', () => this.update());
    this.update();
  }

  /** Whoever began it. */
  private get looking(): boolean {
    return this.lead.leading || this.app.classState?.look != null;
  }

  private toggleLook(): void {
    if (this.looking) this.lead.stop();
    else this.lead.start();
    this.update();
  }

  private askOrClose(): void {
    if (this.app.classState?.question) this.app.send({ do: 'class_ask', question: null });
    else this.editor.open();
  }

  private update(): void {
    const { texts, classState } = this.app;
    const press = (made: HTMLButtonElement, on: boolean, onKey: string, offKey: string) => {
      texts.bind(made, on ? onKey : offKey);
      made.setAttribute('aria-pressed', String(on));
    };
    press(this.look, this.looking, 'web.class.look_end', 'web.class.look');
    press(this.freeze, classState?.frozen === true, 'web.class.unfreeze', 'web.class.freeze');
    press(this.ask, classState?.question != null, 'web.question.close', 'web.question.new');
    texts.bindAttribute(this.look, 'title', 'web.class.look.tip');
    texts.bindAttribute(this.freeze, 'title', 'web.class.freeze.tip');
    const { members = [], question = null, lesson = null, students = 0 } = classState ?? {};
    const hands = members.filter((member) => member.hand_up).length;
    texts.bind(this.summary, 'web.class.students', students, hands);
    const { news } = this;
    if (news.lessons.of(texts.language, lesson)) this.showLessons(lesson);
    if (news.answers.of(texts.language, question, members)) this.showAnswers(question, members);
    const asked = question !== null;
    if (news.members.of(texts.language, members, asked)) refill(this.members, membersView(this.app, members, asked));
  }

  private showLessons(given: string | null): void {
    const { app, lessons, offered } = this;
    const option = (value: string, text: string) => el('option', { value, text });
    refill(
      lessons,
      option('', app.texts.t('web.class.no_lesson')),
      ...offered.map(({ key, title }) => option(key, title)),
    );
    lessons.value = given ?? '';
    lessons.disabled = offered.length === 0;
  }

  private showAnswers(question: Question | null, members: readonly Member[]): void {
    refill(this.answers, ...(question ? this.counts(question, members) : []));
  }

  private counts(question: Question, members: readonly Member[]): HTMLElement[] {
    const { app } = this;
    const counts = countAnswers(question, members);
    const bars = counts.map(({ option, students, share }) => {
      const fill = el('div', { class: 'share-fill' });
      fill.style.width = `${100 * share}%`;
      return el('li', { class: 'share' }, fill, el('span', { class: 'share-text', text: `${option}: ${students}` }));
    });
    const answered = counts.reduce((sum, { students }) => sum + students, 0);
    const students = members.filter(({ role }) => role === 'student').length;
    const said = el('p', { class: 'quiet small', text: app.texts.t('web.question.answered', answered, students) });
    return [el('h3', { text: question.text }), el('ul', { class: 'bars' }, ...bars), said];
  }
}
