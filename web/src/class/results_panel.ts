/** What came of the class's lessons, one line a student and lesson; every step goes into the CSV file. */

import { button, el, refill } from '../app/dom';
import type { App } from '../app/state';
import { pointsText } from '../learn/widgets';
import { fileName, saveFile, timeStamp } from '../record/save_file';
import { News } from './news';
import { linesOf, resultsCsv, type Line } from './results';

const COLUMNS = ['web.results.name', 'web.results.lesson', 'web.results.steps', 'web.results.points'] as const;

export class ResultsPanel {
  readonly element: HTMLElement;
  private readonly table = el('div', { class: 'scroll' });
  private readonly save: HTMLButtonElement;
  private readonly news = new News();

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
    const results = classState?.results ?? [];
    if (!this.news.of(texts.language, results)) return;
    const lines = linesOf(results);
    this.save.disabled = lines.length === 0;
    if (lines.length === 0) {
      refill(this.table, el('p', { class: 'quiet small', text: t('web.results.none') }));
      return;
    }
    const head = el('tr', {}, ...COLUMNS.map((key) => el('th', { scope: 'col', text: t(key) })));
    const rows = lines.map((line) => el('tr', {}, ...this.cells(line).map((text) => el('td', { text }))));
    refill(this.table, el('table', {}, el('thead', {}, head), el('tbody', {}, ...rows)));
  }

  private cells({ name, lesson, steps, points, of }: Line): string[] {
    return [name, lesson, String(steps), this.app.texts.t('web.results.of', pointsText(points), pointsText(of))];
  }

  private download(): void {
    const name = fileName(`myotact-${this.app.scene.name}-${timeStamp()}`, '.csv');
    saveFile(name, 'text/csv;charset=utf-8', resultsCsv(this.app.classState?.results ?? []));
  }
}
