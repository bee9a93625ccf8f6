/** The texts of the page: one flat table a language, English where a language lacks a key. */

import type { Texts } from '../app/state';
import { kept } from '../app/storage';
import { format, type Value } from './format';

export type Dictionary = Record<string, string>;

export const LANGUAGES: readonly string[] = ['en', 'de'];
const FALLBACK = 'en';

/** The language chosen last time, else the first of the browser's that is there, else English. */
export function preferredLanguage(): string {
  const wanted = [
    kept.ofBrowser.get('language') ?? '',
    ...navigator.languages.map((code) => code.slice(0, 2).toLowerCase()),
  ];
  return wanted.find((code) => LANGUAGES.includes(code)) ?? FALLBACK;
}

/** What an element shows: by slot ('' its text, else the attribute) a key and the values in its places. */
type Bound = Map<string, { key: string; values: Value[] }>;

class PageTexts implements Texts {
  readonly languages: readonly string[];
  private chosen: string;
  // Weak, since an element that left the page must not be kept for its text.
  private readonly bound = new WeakMap<Element, Bound>();
  private readonly elements = new Set<WeakRef<Element>>();
  private readonly listeners = new Set<(language: string) => void>();

  constructor(
    private readonly dictionaries: Record<string, Dictionary>,
    language: string,
  ) {
    this.languages = Object.keys(dictionaries);
    this.chosen = language in dictionaries ? language : FALLBACK;
  }

  get language(): string {
    return this.chosen;
  }

  has(key: string): boolean {
    return this.find(key) !== undefined;
  }

  t(key: string, ...values: Value[]): string {
    return format(this.find(key) ?? key, ...values);
  }

  bind<E extends Element>(element: E, key: string, ...values: Value[]): E {
    return this.keep(element, '', key, values);
  }

  bindAttribute<E extends Element>(element: E, attribute: string, key: string, ...values: Value[]): E {
    return this.keep(element, attribute, key, values);
  }

  /** A language that is not there leaves the page as it is. */
  choose(language: string): void {
    if (!this.languages.includes(language)) return;
    kept.ofBrowser.set('language', language);
    this.chosen = language;
    this.showAll();
    for (const listener of [...this.listeners]) listener(language);
  }

  onChange(listener: (language: string) => void): () => void {
    this.listeners.add(listener);
    return () => this.listeners.delete(listener);
  }

  private find(key: string): string | undefined {
    for (const language of [this.chosen, FALLBACK]) {
      const texts = this.dictionaries[language];
      if (texts && Object.hasOwn(texts, key)) return texts[key];
    }
    return undefined;
  }

  private keep<E extends Element>(element: E, slot: string, key: string, values: Value[]): E {
    let bound = this.bound.get(element);
    if (!bound) {
      bound = new Map();
      this.bound.set(element, bound);
      this.elements.add(new WeakRef(element));
    }
    bound.set(slot, { key, values });
    this.show(element, bound);
    return element;
  }

  private showAll(): void {
    for (const reference of this.elements) {
      const element = reference.deref();
      const bound = element && this.bound.get(element);
      if (element && bound) this.show(element, bound);
      else this.elements.delete(reference);
    }
  }

  private show(element: Element, bound: Bound): void {
    for (const [slot, { key, values }] of bound) {
      const text = this.t(key, ...values);
      if (slot !== '') element.setAttribute(slot, text);
      else if (element.textContent !== text) element.textContent = text; // a screen reader would say it again
    }
  }
}

/** `dictionaries` by language, English among them. */
export function createTexts(dictionaries: Record<string, Dictionary>, language = preferredLanguage()): Texts {
  return new PageTexts(dictionaries, language);
}
