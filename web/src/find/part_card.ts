/** What is known of the selected part, and what a muscle does now. */

import { button, el, refill } from '../app/dom';
import type { MusclePart, Part } from '../app/facts';
import type { App } from '../app/state';
import { isolate, setState, stateOf, type State } from './shown';

export class PartCard {
  readonly element = el('div', { class: 'card' });
  private readonly now = el('p', { class: 'now' });
  private readonly states = new Map<State, HTMLButtonElement>();
  private names = ''; // the choice of names that the card was built for

  constructor(private readonly app: App) {
    app.on('selection', (key) => {
      this.build();
      if (key !== null) this.element.scrollIntoView({ block: 'nearest' });
    });
    app.on('look', ({ names }) => (names === this.names ? this.markState() : this.build()));
    app.on('language', () => this.build());
    app.on('readings', () => this.update());
    this.build();
  }

  private get part(): Part | null {
    const { selection, look } = this.app;
    return selection === null || look.names === 'none' ? null : (this.app.part(selection) ?? null);
  }

  private build(): void {
    const { part } = this;
    const { t } = this.words();
    this.names = this.app.look.names;
    if (!part) {
      const key = this.app.look.names === 'none' ? 'learn.names_hidden' : 'web.card.nothing';
      refill(this.element, el('p', { class: 'quiet small', text: t(key) }));
      return;
    }
    const names = [el('h3', { text: part.english }), el('p', { class: 'latin', lang: 'la', text: part.latin })];
    const synonyms = el('p', { class: 'quiet small', text: part.synonyms.join(', ') });
    synonyms.hidden = part.synonyms.length === 0;
    const facts = part.kind === 'muscle' ? this.facts(part) : [];
    refill(this.element, ...names, synonyms, ...facts, this.buttons(part));
    this.update();
  }

  private facts(muscle: MusclePart): HTMLElement[] {
    const { t } = this.words();
    const does = `function.${muscle.function}`;
    const rows = (['origin', 'insertion', 'action', 'innervation'] as const).flatMap((key) => {
      return muscle[key] === ''
        ? []
        : [el('dt', { text: t(`card.${key}`) }), el('dd', { lang: 'en', text: muscle[key] })];
    });
    const { peak_force_N, optimal_fibre_m } = muscle;
    const strength = t('card.mechanics_estimated', peak_force_N, 1000 * optimal_fibre_m);
    return [
      el('p', { class: 'function', text: this.app.texts.has(does) ? t(does) : muscle.function }),
      el('dl', {}, ...rows),
      el('p', { class: 'quiet small', text: peak_force_N > 0 ? strength : '' }),
      this.now,
    ];
  }

  private buttons(part: Part): HTMLElement {
    const { app } = this;
    const make = (key: string, action: () => void, className = 'plain') => {
      const made = button(className, action);
      made.textContent = this.words().t(key);
      return made;
    };
    const set = (state: State, key: string) => {
      const made = make(key, () => setState(app, part.key, state), 'toggle');
      this.states.set(state, made);
      return made;
    };
    const states = [set('shown', 'menu.show'), set('faded', 'menu.fade'), set('hidden', 'menu.hide')];
    const alone = make('menu.isolate', () => isolate(app, part.key));
    const near = make('menu.frame', () => app.camera.frame(part.key));
    this.markState();
    return el('div', { class: 'row wrap' }, ...states, alone, near);
  }

  private markState(): void {
    const { part } = this;
    if (!part) return;
    const now = stateOf(this.app.look, part.key);
    for (const [state, made] of this.states) made.setAttribute('aria-pressed', String(state === now));
  }

  private update(): void {
    const { readings } = this.app;
    const { part } = this;
    if (part?.kind !== 'muscle' || !readings) return;
    const activation = readings.activations[part.index] ?? 0;
    this.now.textContent = this.words().t('card.now', 100 * activation, readings.tensions_N[part.index] ?? 0);
  }

  private words(): Pick<App['texts'], 't'> {
    return { t: (key, ...values) => this.app.texts.t(key, ...values) };
  }
}
