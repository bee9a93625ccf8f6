/** Search of parts by any of their names, with slips of typing forgiven; the best first. */

import { typingSlips } from './slips';

/** What a search looks through; `/scene.json`'s muscles and bones are such. */
export interface NamedPart {
  key: string;
  english: string;
  latin: string;
  synonyms: readonly string[];
}

export interface Found {
  kind: 'muscle' | 'bone';
  index: number;
  rank: number; // 0 the best
}

const LONGEST_WORD = 40; // letters; what is longer is cut, so that no input makes a search slow
const SHORTEST_INSIDE = 3; // letters that may stand anywhere within a word

/** Words of small letters and digits without accents; anything else parts them. */
export function plainWords(text: string): string[] {
  const plain = text.toLowerCase().replace(/ß/g, 'ss').normalize('NFD').replace(/\p{M}/gu, '');
  return (plain.match(/[a-z0-9]+/g) ?? []).map((word) => word.slice(0, LONGEST_WORD));
}

const wordsOfParts = new WeakMap<NamedPart, string[][]>(); // of all their names, since every letter typed asks again

function wordsOf(part: NamedPart): string[][] {
  let words = wordsOfParts.get(part);
  if (!words) {
    words = [part.english, part.latin, part.key, ...part.synonyms].map(plainWords);
    wordsOfParts.set(part, words);
  }
  return words;
}

function allowedSlips(letters: number): number {
  if (letters >= 7) return 2;
  return letters >= 4 ? 1 : 0;
}

/** 0 the word itself, 1 its beginning, 2 a piece of it, above with slips: of the whole word, then of its beginning. */
function wordRank(typed: string, word: string): number | null {
  if (word === typed) return 0;
  if (word.startsWith(typed)) return 1;
  if (typed.length >= SHORTEST_INSIDE && word.includes(typed)) return 2;
  const allowed = allowedSlips(typed.length);
  const slips = typingSlips(typed, word);
  if (slips <= allowed) return 2 + slips;
  let fewest = allowed + 1;
  for (let length = typed.length - 1; length <= typed.length + 1 && length < word.length; ++length) {
    fewest = Math.min(fewest, typingSlips(typed, word.slice(0, length)));
  }
  return fewest > allowed ? null : 2 + allowed + fewest;
}

/** Every typed word must be one of the name's; the worst of them counts, less where the name begins with it. */
function nameRank(typed: readonly string[], words: readonly string[]): number | null {
  let worst = 0;
  for (const wanted of typed) {
    let best: number | null = null;
    words.forEach((word, place) => {
      const rank = wordRank(wanted, word);
      if (rank === null) return;
      const here = 2 * rank + (place === 0 ? 0 : 1);
      if (best === null || here < best) best = here;
    });
    if (best === null) return null;
    worst = Math.max(worst, best);
  }
  return worst;
}

function partRank(typed: readonly string[], part: NamedPart): number | null {
  let best: number | null = null;
  for (const words of wordsOf(part)) {
    const rank = nameRank(typed, words);
    if (rank !== null && (best === null || rank < best)) best = rank;
  }
  return best;
}

/** Parts that the text may mean, equals in the order of the scene; none for a text without a letter. */
export function findParts(text: string, muscles: readonly NamedPart[], bones: readonly NamedPart[]): Found[] {
  const typed = plainWords(text);
  if (typed.length === 0) return [];
  const found: Found[] = [];
  const look = (parts: readonly NamedPart[], kind: Found['kind']) => {
    parts.forEach((part, index) => {
      const rank = partRank(typed, part);
      if (rank !== null) found.push({ kind, index, rank });
    });
  };
  look(muscles, 'muscle');
  look(bones, 'bone');
  return found.sort((a, b) => a.rank - b.rank);
}
