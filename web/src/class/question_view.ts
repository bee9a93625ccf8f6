/**
 * The question to a student: big buttons over the limb. An answer may be changed until the question is closed; after a
 * break it is sent again, since the server has forgotten it.
 */

import { el, refill } from '../app/dom';
import type { App, Question } from '../app/state';
import { textButton } from '../learn/widgets';

export class QuestionView {
  private readonly box = el('section', { class: 'question', role: 'group' });
  private shown: Question | null = null;
  private answer: string | null = null;
  private owed = false; // the new connection's server has not heard the answer
  private hide: (() => void) | null = null;

  constructor(private readonly app: App) {
    app.on('connection', () => (this.owed = true));
    app.on('class', ({ question }) => this.take(question));
    app.on('language', () => this.draw());
    this.take(app.classState?.question ?? null);
  }

  private take(question: Question | null): void {
    if (question?.id !== this.shown?.id) this.answer = null;
    const changed = JSON.stringify(question) !== JSON.stringify(this.shown);
    this.shown = question;
    if (changed) this.draw();
    if (this.owed && this.app.connection.state === 'joined') this.send();
  }

  private send(): void {
    const { app, shown, answer } = this;
    this.owed = app.connection.state !== 'joined';
    if (shown && answer !== null) app.send({ do: 'class_answer', question: shown.id, answer });
  }

  private draw(): void {
    const { app, shown } = this;
    if (!shown) {
      this.hide?.();
      this.hide = null;
      return;
    }
    const title = el('h2', { text: shown.text });
    this.box.setAttribute('aria-label', shown.text);
    const options = shown.options.map((option) => this.option(option));
    const said =
      this.answer === null ? app.texts.t('web.question.choose') : app.texts.t('web.question.sent', this.answer);
    refill(this.box, title, el('div', { class: 'answers' }, ...options), el('p', { role: 'status', text: said }));
    this.hide ??= app.mountOver(this.box);
  }

  private option(option: string): HTMLButtonElement {
    const made = textButton(option, 'answer', () => {
      this.answer = option;
      this.send();
      this.draw();
      this.focus(option);
    });
    made.setAttribute('aria-pressed', String(option === this.answer));
    return made;
  }

  /** The buttons were made anew: who came by keyboard stays where they were. */
  private focus(option: string): void {
    const buttons = [...this.box.querySelectorAll('button')];
    buttons.find((made) => made.textContent === option)?.focus();
  }
}
