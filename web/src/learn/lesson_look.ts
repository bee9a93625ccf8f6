/** What a step wants shown and set, in the page's terms. */

import type { Colouring, Look } from '../app/look';
import type { InForce } from '../wire/moment';
import { hidesNames, keyOf, markedPart, type Anatomy, type Setting, type Step } from './lesson';

/** The page colours by fewer things than the window; what it does not know leaves the muscles as they are. */
const COLOURS: Partial<Record<Step['show']['colour'], Colouring>> = {
  kind: 'kind',
  activation: 'activation',
  tension: 'tension',
};

function keysOf(parts: Anatomy['muscles'], shown: readonly number[] | null): string[] {
  const keys = parts.map((part) => part.key);
  return shown ? keys.filter((_, index) => shown.includes(index)) : keys;
}

/** `names`: how the person wants parts called where a task does not hide it. */
export function lookOfStep({ show, task }: Step, anatomy: Anatomy, names: Look['names']): Partial<Look> {
  const hidden = hidesNames(task);
  const { muscles, bones } = show;
  const whole = muscles === null && bones === null;
  return {
    parts: Object.fromEntries(show.faded.map((part) => [keyOf(anatomy, part), 'faded'])),
    only: whole ? null : [...keysOf(anatomy.muscles, muscles), ...keysOf(anatomy.bones, bones)],
    layers: { superficial: 1, deep: 1, bones: 1 },
    colour: COLOURS[show.colour] ?? 'own',
    labels: show.labels && !hidden,
    names: hidden ? 'none' : names,
    marked: keyOf(anatomy, markedPart(task)) || null,
  };
}

/** The Controls that set the scene for a step; only an instructor's are obeyed. */
export function controlsOf(set: Setting, now: InForce | null): object[] {
  const controls: object[] = [];
  const { common = now?.common ?? 0, difference = now?.difference ?? 0 } = set;
  if (set.common !== undefined || set.difference !== undefined)
    controls.push({ do: 'co_contract', common, difference });
  if (set.flexors !== undefined) controls.push({ do: 'levels', flexors: set.flexors, extensors: set.extensors });
  if (set.hold_posture !== undefined) controls.push({ do: 'hold_posture', on: set.hold_posture });
  if (set.gravity !== undefined) controls.push({ do: 'gravity', on: set.gravity });
  return controls;
}
