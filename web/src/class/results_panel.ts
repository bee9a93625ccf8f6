/** What came of the class's lessons and questions, one line a student and lesson; every step goes into the CSV file. */

import { button, el, refill } from '../app/dom';
import type { App, ClassResult } from '../app/state';
import { pointsText } from '../learn/widgets';
import { fileName, saveFile, timeStamp } from '../record/save_file';
import { Answers, QUESTION } from './answers';
import { News } from './news';
import { linesOf, resultsCsv, type Line } from './results';

const COLUMNS = ['web.results.name', 'web.results.lesson', 'web.results.steps', 'web.results.points'] as const;

export class ResultsPanel {
  readonly element: HTMLElement;
  private readonly table = el('div', { class: 'scroll' });
  private readonly save: HTMLButtonElement;
  private readonly news = new News();
  private readonly answers = new Answers();

  constructor(private readonly app: App) {
    this.save = app.texts.bind(
      button('plain', () => this.download()),
      'web.results.save',
    );
    this.element = el('div', { class: 'results' }, this.table, this.save);
    app.on('class', () => this.update());
    app.on('language', () => this.update());
    this.update();
  }

  private update(): void {
    const { texts, classState } = this.app;
    const t = texts.t.bind(texts);
    if (classState) this.answers.take(classState);
    const newest = classState?.results?.at(-1)?.number;
    if (!this.news.of(texts.language, newest, this.answers.newest)) return;
    const lines = linesOf(this.results);
    this.save.disabled = lines.length === 0;
    if (lines.length === 0) {
      refill(this.table, el('p', { class: 'quiet small', text: t('web.results.none') }));
      return;
    }
    const head = el('tr', {}, ...COLUMNS.map((key) => el('th', { scope: 'col', text: t(key) })));
    const rows = lines.map((line) => el('tr', {}, ...this.cells(line).map((text) => el('td', { text }))));
    refill(this.table, el('table', {}, el('thead', {}, head), el('tbody', {}, ...rows)));
  }

  private get results(): ClassResult[] {
    return this.answers.among(this.app.classState?.results ?? []);
  }

  private cells({ name, lesson, steps, points, of }: Line): string[] {
    const { texts } = this.app;
    const what = lesson === QUESTION ? texts.t('web.question.text') : lesson;
    return [name, what, String(steps), of === 0 ? '' : texts.t('web.results.of', pointsText(points), pointsText(of))];
  }

  private download(): void {
    const name = fileName(`myotact-${this.app.scene.name}-${timeStamp()}`, '.csv');
    saveFile(name, 'text/csv;charset=utf-8', resultsCsv(this.results));
  }
}
