/** Search and list of all parts by region: what can be clicked on the limb can be chosen here by keyboard. */

import { button, el, refill } from '../app/dom';
import type { Part } from '../app/facts';
import type { App } from '../app/state';
import { findParts } from './search';
import { isolate, isPlain, setState, showAll, stateOf } from './shown';

interface Row {
  element: HTMLElement;
  name: HTMLButtonElement;
  eye: HTMLButtonElement;
}

export class PartList {
  readonly element = el('div', { class: 'find' });
  private readonly search = el('input', { type: 'search', autocomplete: 'off', spellcheck: 'false', maxlength: '80' });
  private readonly list = el('div', { class: 'part-list' });
  private readonly all: HTMLButtonElement;
  private rows = new Map<string, Row>();
  private names = ''; // the choice of names that the list was built for

  constructor(private readonly app: App) {
    const { texts } = app;
    texts.bindAttribute(this.search, 'placeholder', 'find.search');
    texts.bindAttribute(this.search, 'aria-label', 'find.search');
    texts.bindAttribute(this.search, 'title', 'find.search.tip');
    this.search.addEventListener('input', () => this.build());
    this.search.addEventListener('keydown', (event) => this.key(event));
    this.all = texts.bind(
      button('plain', () => showAll(app)),
      'menu.show_all',
    );
    refill(this.element, this.search, this.list, this.all);
    app.on('selection', (key) => this.mark(key, true));
    app.on('look', ({ names }) => (names === this.names ? this.markAll() : this.build()));
    app.on('language', () => this.build());
    this.build();
  }

  /** Enter takes the first that was found; an arrow goes into the list. */
  private key(event: KeyboardEvent): void {
    const first = this.rows.entries().next().value;
    if (event.key === 'Escape') {
      this.search.value = '';
      this.build();
    } else if (first && event.key === 'Enter') this.choose(first[0]);
    else if (first && event.key === 'ArrowDown') first[1].name.focus();
    else return;
    event.preventDefault();
  }

  private choose(key: string): void {
    this.app.select(key);
    if (stateOf(this.app.look, key) === 'hidden') setState(this.app, key, 'shown');
  }

  private build(): void {
    const { app } = this;
    this.rows = new Map();
    this.names = app.look.names;
    const hidden = this.names === 'none';
    this.search.disabled = hidden;
    if (hidden) refill(this.list, el('p', { class: 'quiet small', text: app.texts.t('learn.names_hidden') }));
    else refill(this.list, ...(this.search.value.trim() === '' ? this.regions() : this.found()));
    this.markAll();
  }

  private regions(): HTMLElement[] {
    const regions = new Map<string, Part[]>();
    const add = (heading: string, part: Part) => regions.set(heading, [...(regions.get(heading) ?? []), part]);
    for (const part of this.app.parts) {
      if (part.kind === 'muscle') add(part.region ? `region.${part.region}` : 'find.elsewhere', part);
    }
    for (const part of this.app.parts) if (part.kind === 'bone') add('find.bones', part);
    return [...regions].map(([heading, parts]) => {
      const title = el('summary', { text: this.app.texts.t(heading) }, ` (${parts.length})`);
      const group = el('details', { class: 'region' }, title, ...parts.map((part) => this.row(part)));
      group.open = heading !== 'find.bones';
      return group;
    });
  }

  private found(): HTMLElement[] {
    const { scene, parts, texts } = this.app;
    const found = findParts(this.search.value, scene.muscles, scene.bones);
    const nothing = el('p', { class: 'quiet small', text: texts.t('find.nothing', this.search.value.trim()) });
    if (found.length === 0) return [nothing];
    return found.flatMap(({ kind, index }) => {
      const part = parts.find((other) => other.kind === kind && other.index === index);
      return part ? [this.row(part)] : [];
    });
  }

  private row(part: Part): HTMLElement {
    const { app } = this;
    const name = button(`part ${part.kind}`, () => this.choose(part.key));
    name.textContent = app.nameOf(part.key);
    name.title = `${part.english}, ${part.latin}`;
    name.addEventListener('dblclick', () => isolate(app, part.key));
    const eye = button('eye', () => setState(app, part.key, nextState(stateOf(app.look, part.key))));
    const element = el('div', { class: 'row' }, name, eye);
    this.rows.set(part.key, { element, name, eye });
    return element;
  }

  private markAll(): void {
    for (const key of this.rows.keys()) this.mark(key, false);
    this.all.disabled = isPlain(this.app.look);
  }

  private mark(selected: string | null, came: boolean): void {
    const { look, selection, texts } = this.app;
    for (const [key, { element, name, eye }] of this.rows) {
      if (!came && key !== selected) continue;
      const state = stateOf(look, key);
      element.dataset['state'] = state;
      name.setAttribute('aria-pressed', String(key === selection));
      const does = { shown: 'menu.fade', faded: 'menu.hide', hidden: 'menu.show' }[state];
      eye.setAttribute('aria-label', `${texts.t(does)}: ${name.textContent ?? ''}`);
      eye.title = texts.t(does);
      if (came && key === selection) element.scrollIntoView({ block: 'nearest' });
    }
  }
}

function nextState(state: 'shown' | 'faded' | 'hidden'): 'shown' | 'faded' | 'hidden' {
  if (state === 'shown') return 'faded';
  return state === 'faded' ? 'hidden' : 'shown';
}
