/** How solid the look has each part drawn. */
import type { Part } from '../app/facts';
import type { Look } from '../app/look';

export const FADED = 0.2;

/** 0: gone, 1: solid. */
export function solidity(part: Part, look: Look): number {
  const set = look.parts[part.key];
  if (set === 'hidden' || (look.only !== null && !look.only.includes(part.key))) return 0;
  const layer = look.layers[part.kind === 'bone' ? 'bones' : part.layer];
  return Math.min(layer, set === 'faded' ? FADED : 1);
}

/** Whether a pointer finds it. */
export function isSolid(part: Part, look: Look): boolean {
  return solidity(part, look) > 0.5;
}
