/** A small editor for a question: its text and two to six options. */

import { button, el, refill } from '../app/dom';
import type { App, Question } from '../app/state';
import { textButton } from '../learn/widgets';
import { FEWEST_OPTIONS, LONGEST_OPTION, LONGEST_TEXT, makeQuestion, MOST_OPTIONS, newQuestionId } from './question';

const FIRST_OPTIONS = 4;

export class QuestionEditor {
  private readonly dialog = el('dialog', { class: 'dialog' });
  private readonly text = el('textarea', { rows: '2', maxlength: String(LONGEST_TEXT) });
  private readonly list = el('div', { class: 'option-list' });
  private readonly ask = button('primary', () => this.send());
  private options: HTMLInputElement[] = [];

  constructor(private readonly app: App) {
    this.text.addEventListener('input', () => this.check());
  }

  open(): void {
    if (this.options.length === 0) for (let i = 0; i < FIRST_OPTIONS; ++i) this.add();
    this.build();
    document.body.append(this.dialog);
    this.dialog.showModal();
    this.text.focus();
  }

  private get question(): Question | null {
    return makeQuestion(
      newQuestionId(),
      this.text.value,
      this.options.map((option) => option.value),
    );
  }

  private send(): void {
    const { question } = this;
    if (!question) return;
    this.app.send({ do: 'class_ask', question });
    this.dialog.close();
  }

  private add(): void {
    const option = el('input', { type: 'text', maxlength: String(LONGEST_OPTION), autocomplete: 'off' });
    option.addEventListener('input', () => this.check());
    this.options.push(option);
  }

  private remove(option: HTMLInputElement): void {
    this.options = this.options.filter((other) => other !== option);
    this.build();
  }

  private build(): void {
    const t = this.app.texts.t.bind(this.app.texts);
    const rows = this.options.map((option, index) => {
      option.setAttribute('aria-label', t('web.question.option', index + 1));
      option.placeholder = t('web.question.option', index + 1);
      const remove = textButton('×', 'plain', () => this.remove(option));
      remove.setAttribute('aria-label', t('web.question.remove', index + 1));
      remove.disabled = this.options.length <= FEWEST_OPTIONS;
      return el('div', { class: 'row' }, option, remove);
    });
    refill(this.list, ...rows);
    const more = textButton(t('web.question.add'), 'plain', () => {
      this.add();
      this.build();
      this.options.at(-1)?.focus();
    });
    more.disabled = this.options.length >= MOST_OPTIONS;
    const cancel = textButton(t('web.cancel'), 'plain', () => this.dialog.close());
    this.ask.textContent = t('web.question.ask');
    const title = el('h2', { text: t('web.question.new') });
    const label = el('label', {}, t('web.question.text'), this.text);
    refill(this.dialog, title, label, this.list, more, el('div', { class: 'row end' }, cancel, this.ask));
    this.check();
  }

  private check(): void {
    this.ask.disabled = this.question === null;
  }
}
