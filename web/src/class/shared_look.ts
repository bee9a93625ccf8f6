/** "All look here": what an instructor sends with class_look, and how much of it a student's page believes. */

import type { CameraPose, Colouring, Look, Names, Shown } from '../app/look';

export interface SharedLook {
  camera: CameraPose;
  view: Partial<Look>;
  selected: string | null;
}

const LONGEST_BYTES = 4096; // the server takes no more
const FARTHEST_M = 100; // a camera beyond that shows nothing

/** As it goes over the wire; without the view where that is too long, since where to look matters most. */
export function packLook(camera: CameraPose, look: Look, selected: string | null): object {
  const whole = { camera: roundedPose(camera), view: { ...look, selected } };
  const bytes = new TextEncoder().encode(JSON.stringify({ do: 'class_look', look: whole })).length;
  return bytes <= LONGEST_BYTES ? whole : { camera: whole.camera, view: { selected } };
}

/** A tenth of a millimetre is less than a pixel. */
function roundedPose({ eye, target }: CameraPose): CameraPose {
  const rounded = (place: CameraPose['eye']) => place.map((x) => Math.round(x * 1e4) / 1e4) as CameraPose['eye'];
  return { eye: rounded(eye), target: rounded(target) };
}

/** Null for what is no look; parts of a view that make no sense are left out. */
export function unpackLook(sent: unknown): SharedLook | null {
  const { camera, view } = membersOf(sent);
  const { eye, target } = membersOf(camera);
  if (!isPlace(eye) || !isPlace(target)) return null;
  const { selected } = membersOf(view);
  return { camera: { eye, target }, view: viewOf(membersOf(view)), selected: isText(selected) ? selected : null };
}

function membersOf(value: unknown): Record<string, unknown> {
  return typeof value === 'object' && value !== null && !Array.isArray(value) ? (value as Record<string, unknown>) : {};
}

function isText(value: unknown): value is string {
  return typeof value === 'string';
}

function isPlace(value: unknown): value is [number, number, number] {
  const isLength = (x: unknown) => typeof x === 'number' && Math.abs(x) <= FARTHEST_M;
  return Array.isArray(value) && value.length === 3 && value.every(isLength);
}

function oneOf<Word extends string>(value: unknown, words: readonly Word[]): Word | undefined {
  return words.find((word) => word === value);
}

function viewOf(sent: Record<string, unknown>): Partial<Look> {
  const view: Partial<Look> = {};
  const { only, labels, lines, marked, layers } = sent;
  const colour = oneOf<Colouring>(sent['colour'], ['own', 'kind', 'activation', 'tension']);
  const names = oneOf<Names>(sent['names'], ['english', 'latin', 'none']);
  if (typeof sent['parts'] === 'object') view.parts = partsOf(membersOf(sent['parts']));
  if (only === null) view.only = null;
  else if (Array.isArray(only) && only.every(isText)) view.only = only;
  const { superficial, deep, bones } = membersOf(layers);
  if (isShare(superficial) && isShare(deep) && isShare(bones)) view.layers = { superficial, deep, bones };
  if (colour) view.colour = colour;
  if (names) view.names = names;
  if (typeof labels === 'boolean') view.labels = labels;
  if (typeof lines === 'boolean') view.lines = lines;
  if (marked === null || isText(marked)) view.marked = marked;
  return view;
}

function isShare(value: unknown): value is number {
  return typeof value === 'number' && value >= 0 && value <= 1;
}

function partsOf(sent: Record<string, unknown>): Record<string, Shown> {
  const parts: Record<string, Shown> = {};
  for (const [key, value] of Object.entries(sent)) {
    const shown = oneOf<Shown>(value, ['faded', 'hidden']);
    if (shown) parts[key] = shown;
  }
  return parts;
}
