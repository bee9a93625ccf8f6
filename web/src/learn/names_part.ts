/** Whether a typed name means a part. */

import { typingSlips } from '../find/slips';
import { partsOf, samePart, type Anatomy, type Part } from './lesson';

const LONG_WORD = 5; // letters; shorter words may hold no slip
const LONGEST = 100; // letters; no name is longer, and comparing is quadratic

/** Small words; what students leave out of a muscle's name is left out. */
function plainName(text: string): string[] {
  const words = text.toLowerCase().match(/[a-z0-9\u0080-\uffff]+/g) ?? [];
  return words.filter((word) => !['m', 'musculus', 'muscle'].includes(word));
}

/** Slips by which two names differ, at most one in each long word: biceps is no slip of triceps. */
function slipsBetween(typed: readonly string[], name: readonly string[]): number {
  if (typed.length !== name.length) return Infinity;
  let slips = 0;
  for (const [place, word] of name.entries()) {
    const here = typingSlips(typed[place] ?? '', word);
    if (here > (word.length < LONG_WORD ? 0 : 1)) return Infinity;
    slips += here;
  }
  return slips;
}

function slipsTo(typed: readonly string[], names: readonly string[]): number {
  return Math.min(...names.map((name) => slipsBetween(typed, plainName(name))));
}

function namesOf(anatomy: Anatomy, part: Part): string[] {
  const names = partsOf(anatomy, part.kind)[part.index];
  if (!names) return [];
  const ownKey = names.key.slice(names.key.indexOf('.') + 1); // a key may begin with its limb: "hind.gracilis"
  return [...names.synonyms, ownKey, names.latin, names.english];
}

/**
 * Its key, Latin or English name, a synonym or one of `accept`, capitals and spaces aside, "m." for "musculus", and
 * with one slip of typing in each long word, unless that is another part's name.
 */
export function namesPart(text: string, part: Part, anatomy: Anatomy, accept: readonly string[] = []): boolean {
  const typed = plainName(text.slice(0, LONGEST));
  if (typed.length === 0) return false;
  const slips = slipsTo(typed, [...namesOf(anatomy, part), ...accept]);
  if (slips === 0) return true;
  if (slips === Infinity) return false;
  // A slip must not make one muscle's name out of another's: tibialis cranialis, tibialis caudalis.
  const isNearer = (kind: Part['kind']) =>
    partsOf(anatomy, kind).some((_, index) => {
      const other = { kind, index };
      return !samePart(other, part) && slipsTo(typed, namesOf(anatomy, other)) <= slips;
    });
  return !isNearer('muscle') && !isNearer('bone');
}
