/** Places names in two columns beside the limb, each at the height of what it names as far as there is room. */

export interface Pin {
  x: number;
  y: number;
  width: number;
}

export interface Placed {
  side: 'left' | 'right';
  /** Middle of the name's height. */
  y: number;
}

/** Null: there is no room for it. Names that are pushed away least keep their place. */
export function placeLabels(pins: Pin[], height: number, row: number): (Placed | null)[] {
  const middle = median(pins.map((pin) => pin.x));
  const placed: (Placed | null)[] = pins.map(() => null);
  for (const side of ['left', 'right'] as const) {
    const own = pins.map((_, i) => i).filter((i) => pins[i]!.x < middle === (side === 'left'));
    const ordered = own.sort((a, b) => pins[a]!.y - pins[b]!.y).slice(0, Math.floor(height / row) - 1);
    const rows = spread(
      ordered.map((i) => pins[i]!.y),
      row,
      row / 2,
      height - row / 2,
    );
    ordered.forEach((pin, k) => (placed[pin] = { side, y: rows[k]! }));
  }
  return placed;
}

function median(numbers: number[]): number {
  const sorted = [...numbers].sort((a, b) => a - b);
  return sorted[Math.floor(sorted.length / 2)] ?? 0;
}

/**
 * Nearest to the wanted heights, at least `row` apart, within `low` and `high`: neighbours that would overlap form a
 * block about their mean (pool adjacent violators).
 */
export function spread(wanted: number[], row: number, low: number, high: number): number[] {
  const blocks: { sum: number; count: number }[] = [];
  wanted.forEach((y, i) => {
    blocks.push({ sum: y - i * row, count: 1 });
    for (let last = blocks.length - 1; last > 0; --last) {
      const [before, after] = [blocks[last - 1]!, blocks[last]!];
      if (before.sum / before.count <= after.sum / after.count) break;
      blocks.splice(last - 1, 2, { sum: before.sum + after.sum, count: before.count + after.count });
    }
  });
  const most = high - (wanted.length - 1) * row;
  const bases = blocks.flatMap(({ sum, count }) => new Array<number>(count).fill(sum / count));
  return bases.map((base, i) => Math.max(low, Math.min(base, most)) + i * row);
}
