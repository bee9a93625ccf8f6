/** JSON values that know where they stand, so that every complaint names the place, what is there and what may be. */

import { nearestWord } from '../find/slips';

export class BadLesson extends Error {}

/** A value as it appears in a message: short whatever the file holds. */
function shown(value: unknown): string {
  const LONGEST = 60;
  if (Array.isArray(value)) return 'a list';
  if (value !== null && typeof value === 'object') return 'an object';
  const text = JSON.stringify(value) ?? 'nothing';
  return text.length <= LONGEST ? text : `${text.slice(0, LONGEST)}...`;
}

export class Place {
  constructor(
    readonly value: unknown,
    readonly pointer = '',
  ) {}

  error(problem: string): BadLesson {
    return new BadLesson(`${this.pointer || '/'}: ${problem}`);
  }

  number(): number {
    if (typeof this.value !== 'number') throw this.error(`is ${shown(this.value)}; must be a number`);
    return this.value;
  }

  numberBetween(lowest: number, highest: number): number {
    const value = this.number();
    if (!(value >= lowest && value <= highest)) {
      throw this.error(`is ${value}; must be between ${lowest} and ${highest}`);
    }
    return value;
  }

  boolean(): boolean {
    if (typeof this.value !== 'boolean') throw this.error(`is ${shown(this.value)}; must be true or false`);
    return this.value;
  }

  string(): string {
    if (typeof this.value !== 'string') throw this.error(`is ${shown(this.value)}; must be a text in quotes`);
    return this.value;
  }

  /** A text with letters to show, and not so many that they do not fit. */
  text(longest: number): string {
    const text = this.string();
    if (text.trim() === '') throw this.error('is empty; write what is to be shown');
    if (text.length > longest)
      throw this.error(`has ${text.length} letters; must have at most ${longest}, so that it fits`);
    return text;
  }

  oneOf<Word extends string>(allowed: readonly Word[]): Word {
    const word = this.string();
    const found = allowed.find((candidate) => candidate === word);
    if (found !== undefined) return found;
    const nearest = nearestWord(word, allowed);
    throw this.error(`is ${shown(word)}; must be one of ${allowed.join(', ')} (nearest: "${nearest}")`);
  }

  elements(count?: number): Place[] {
    const list = this.value;
    if (!Array.isArray(list)) throw this.error(`is ${shown(list)}; must be a list${count ? ` of ${count}` : ''}`);
    if (count !== undefined && list.length !== count) {
      throw this.error(`has ${list.length} elements; must have ${count}`);
    }
    return list.map((element, index) => new Place(element, `${this.pointer}/${index}`));
  }

  strings(): string[] {
    return this.elements().map((element) => element.string());
  }

  /** As an object whose every key must be asked for before finish(). */
  object(): Members {
    const { value } = this;
    if (value === null || typeof value !== 'object' || Array.isArray(value)) {
      throw this.error(`is ${shown(value)}; must be an object in braces`);
    }
    return new Members(this, value as Record<string, unknown>);
  }
}

export class Members {
  private readonly asked = new Set<string>();

  constructor(
    readonly place: Place,
    private readonly members: Record<string, unknown>,
  ) {}

  find(key: string): Place | null {
    this.asked.add(key);
    if (!Object.hasOwn(this.members, key)) return null;
    const token = key.replace(/~/g, '~0').replace(/\//g, '~1');
    return new Place(this.members[key], `${this.place.pointer}/${token}`);
  }

  at(key: string): Place {
    const found = this.find(key);
    if (!found) throw this.place.error(`the key "${key}" is missing`);
    return found;
  }

  /** Refuses a key that nothing asked for, and names the nearest that is known. */
  finish(): void {
    const unknown = Object.keys(this.members).find((key) => !this.asked.has(key));
    if (unknown === undefined) return;
    const known = [...this.asked].sort();
    const place = this.find(unknown) ?? this.place;
    throw place.error(`unknown key; allowed: ${known.join(', ')} (nearest: "${nearestWord(unknown, known)}")`);
  }
}
