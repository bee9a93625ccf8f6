/** What a muscle's colour means, and the colours that say it. */
import { Color, Vector4 } from 'three';
import type { Group, Part } from '../app/facts';
import type { Colouring } from '../app/look';
import type { Readings } from '../wire/moment';

/** Told apart by all kinds of colour vision (Okabe and Ito). */
export const kindColours: Record<Group, string> = { flexor: '#1f78b4', extensor: '#e08214', other: '#8d8d93' };

/** From nothing to all, as light grows too. */
const scaleColours = ['#7c2f3a', '#b8383d', '#e2672f', '#f6a821', '#fbe45b'];
const scaleStops = scaleColours.map((colour) => new Color(colour));
/** Tension of the scale's end [N]; peak forces of the larger muscles are a few hundred. */
export const FULL_TENSION_N = 200;
const SHARE = 0.88;

export function scaleGradient(): string {
  return `linear-gradient(90deg, ${scaleColours.join(', ')})`;
}

function onScale(share: number): Color {
  const at = Math.min(Math.max(share, 0), 0.9999) * (scaleStops.length - 1);
  return new Color().lerpColors(scaleStops[Math.floor(at)]!, scaleStops[Math.floor(at) + 1]!, at % 1);
}

/** What is laid over a part's own colour: colour and share. */
export function laidOver(part: Part, colour: Colouring, readings: Readings | null, into: Vector4): Vector4 {
  if (part.kind === 'bone' || colour === 'own') return into.set(0, 0, 0, 0);
  const shown = shownColour(part, colour, readings);
  return into.set(shown.r, shown.g, shown.b, SHARE);
}

function shownColour(part: Part & { kind: 'muscle' }, colour: Colouring, readings: Readings | null): Color {
  if (colour === 'kind') return new Color(kindColours[part.group]);
  if (colour === 'activation') return onScale(readings?.activations[part.index] ?? 0);
  return onScale((readings?.tensions_N[part.index] ?? 0) / FULL_TENSION_N);
}
