/**
 * Slips of typing between two words: letters wrong, missing or too many, neighbours swapped (Damerau-Levenshtein as
 * optimal string alignment: no letter is moved twice).
 */
export function typingSlips(a: string, b: string): number {
  let before: number[] = [];
  let last = Array.from({ length: b.length + 1 }, (_, j) => j);
  for (let i = 1; i <= a.length; ++i) {
    const row = [i];
    for (let j = 1; j <= b.length; ++j) {
      const same = a[i - 1] === b[j - 1];
      let fewest = Math.min(at(last, j) + 1, at(row, j - 1) + 1, at(last, j - 1) + (same ? 0 : 1));
      const swapped = i > 1 && j > 1 && a[i - 1] === b[j - 2] && a[i - 2] === b[j - 1];
      if (swapped) fewest = Math.min(fewest, at(before, j - 2) + 1);
      row.push(fewest);
    }
    before = last;
    last = row;
  }
  return at(last, b.length);
}

function at(row: number[], index: number): number {
  return row[index] ?? Infinity;
}

/** The candidate with the fewest slips; a beginning of it counts as one slip, since names are often shortened. */
export function nearestWord(word: string, candidates: readonly string[]): string {
  const LONGEST = 64; // comparing is quadratic
  const asked = word.slice(0, LONGEST);
  const slips = (name: string) => {
    const beginning = name.length > asked.length ? typingSlips(asked, name.slice(0, asked.length)) + 1 : Infinity;
    return Math.min(typingSlips(asked, name), beginning);
  };
  let nearest = '';
  let fewest = Infinity;
  for (const name of candidates) {
    const here = slips(name);
    if (here < fewest) [nearest, fewest] = [name, here];
  }
  return nearest;
}
