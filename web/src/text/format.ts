/** Fills the places of a text, as the window's texts have them: `{}`, `{:.2f}`, `{:+.3f}`, `{:.2g}`, `{:g}`. */

export type Value = string | number;

const PLACE = /\{(?::([+]?)(?:\.(\d+))?([fg]))?\}/g;

function shown(value: Value, sign: string, decimals: string | undefined, kind: string | undefined): string {
  if (kind === undefined || typeof value === 'string') return String(value);
  const plus = sign === '+' && value >= 0 ? '+' : '';
  if (kind === 'f') return plus + value.toFixed(Number(decimals ?? '6'));
  return plus + String(Number(value.toPrecision(Math.max(1, Number(decimals ?? '6')))));
}

/** A text whose places and values do not fit is shown as it is, so that a slip of a translation costs no more. */
export function format(template: string, ...values: Value[]): string {
  const places = template.match(PLACE)?.length ?? 0;
  if (places > values.length) return template;
  let next = 0;
  return template.replace(PLACE, (_, sign: string, decimals: string | undefined, kind: string | undefined) =>
    shown(values[next++] ?? '', sign ?? '', decimals, kind),
  );
}
