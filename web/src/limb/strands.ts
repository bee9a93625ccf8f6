/**
 * Where each vertex of a muscle lies in its bundle of fibres: across them in two directions and along, so that strands
 * drawn by these run from end to end and close up where the muscle narrows; and how much of it is tendon.
 */
import type { Surface } from './surface';
import { add, cross, distance, dot, length, pointAt, scale, subtract, unit, type Point } from './vectors';

export interface Strands {
  /** Three a vertex: across [m, of the belly's width], across, along [m]. */
  coordinates: Float32Array;
  /** A vertex, 0 belly to 1 tendon. */
  tendon: Float32Array;
}

const SLICES = 16;
/** Tendon where the muscle is thinner than this share of its belly, near an end. */
const THIN = 0.62;
const END_SHARE = 0.3;

/** `line_m`: the muscle's line, x, y, z of each point from origin to insertion, at the time of the drawn skin. */
export function strandsOf(surface: Surface, line_m: ArrayLike<number>): Strands {
  const count = surface.drawn_m.length / 3;
  const points = Array.from({ length: count }, (_, i) => pointAt(surface.drawn_m, i));
  const along = sharesAlong(points, line_m);
  const slices = slicesOf(points, along);
  const belly_m = Math.max(...slices.map((slice) => slice.radius));
  const span_m = slices.slice(1).reduce((sum, slice, i) => sum + distance(slice.centre, slices[i]!.centre), 0);
  const strands: Strands = { coordinates: new Float32Array(3 * count), tendon: new Float32Array(count) };
  points.forEach((point, i) => {
    const slice = sliceAt(slices, along[i]!);
    const out = subtract(point, slice.centre);
    const widen = belly_m / Math.max(slice.radius, 0.1 * belly_m);
    strands.coordinates.set([dot(out, slice.right) * widen, dot(out, slice.up) * widen, along[i]! * span_m], 3 * i);
    strands.tendon[i] = tendonShare(slice.radius / belly_m, along[i]!);
  });
  return strands;
}

function tendonShare(thickness: number, along: number): number {
  const end = 1 - Math.min(along, 1 - along) / END_SHARE;
  const thin = (THIN - thickness) / (0.6 * THIN);
  const tip = 1 - Math.min(along, 1 - along) / 0.07;
  return Math.min(1, Math.max(0, 2 * Math.min(end, thin), tip));
}

/** Of each point, 0 to 1 between the ends of the muscle, measured along its line. */
function sharesAlong(points: Point[], line_m: ArrayLike<number>): number[] {
  const places = points.map((point) => placeOnLine(point, line_m));
  const low = Math.min(...places);
  const high = Math.max(...places);
  return places.map((place) => (place - low) / (high - low || 1));
}

/** Metres from the line's beginning to the place on it that is nearest; goes on beyond both ends. */
function placeOnLine(point: Point, line_m: ArrayLike<number>): number {
  let best = 0;
  let best_m = Infinity;
  let before_m = 0;
  const segments = line_m.length / 3 - 1;
  for (let i = 0; i < segments; ++i) {
    const a = pointAt(line_m, i);
    const b = pointAt(line_m, i + 1);
    const size_m = distance(a, b);
    const direction = unit(subtract(b, a));
    const ahead = dot(subtract(point, a), direction);
    const along = Math.min(i === segments - 1 ? Infinity : size_m, Math.max(i === 0 ? -Infinity : 0, ahead));
    const away_m = distance(point, add(a, scale(direction, along)));
    if (away_m < best_m) [best_m, best] = [away_m, before_m + along];
    before_m += size_m;
  }
  return best;
}

interface Slice {
  centre: Point;
  radius: number;
  right: Point;
  up: Point;
}

function slicesOf(points: Point[], along: number[]): Slice[] {
  const sums = Array.from({ length: SLICES + 1 }, () => ({ centre: [0, 0, 0] as Point, weight: 0 }));
  const each = (use: (slice: number, weight: number, i: number) => void): void =>
    along.forEach((share, i) => {
      const at = Math.min(share * SLICES, SLICES - 1e-6);
      use(Math.floor(at), 1 - (at % 1), i);
      use(Math.floor(at) + 1, at % 1, i);
    });
  each((slice, weight, i) => {
    sums[slice]!.centre = add(sums[slice]!.centre, scale(points[i]!, weight));
    sums[slice]!.weight += weight;
  });
  const centres = smooth(filled(sums));
  const radii = new Array<number>(SLICES + 1).fill(0);
  each((slice, weight, i) => (radii[slice]! += weight * distance(points[i]!, centres[slice]!)));
  return framed(
    centres,
    radii.map((sum, i) => sum / (sums[i]!.weight || 1)),
  );
}

/** A slice without vertices takes the centre of the one before it. */
function filled(sums: { centre: Point; weight: number }[]): Point[] {
  let last = sums.find((sum) => sum.weight > 0)!;
  return sums.map((sum) => {
    if (sum.weight > 0.2) last = sum;
    return scale(last.centre, 1 / last.weight);
  });
}

function smooth(centres: Point[]): Point[] {
  return centres.map((centre, i) => {
    const before = centres[Math.max(0, i - 1)]!;
    const after = centres[Math.min(centres.length - 1, i + 1)]!;
    return add(scale(centre, 0.5), scale(add(before, after), 0.25));
  });
}

/** Axes across the line of centres that turn as little as they can from slice to slice. */
function framed(centres: Point[], radii: number[]): Slice[] {
  let right: Point = [0, 1, 0];
  return centres.map((centre, i) => {
    const ahead = unit(subtract(centres[Math.min(i + 1, SLICES)]!, centres[Math.max(0, i - 1)]!));
    let across = subtract(right, scale(ahead, dot(right, ahead)));
    if (length(across) < 0.1) across = cross(ahead, [1, 0, 0]);
    right = unit(across);
    return { centre, radius: radii[i]!, right, up: cross(ahead, right) };
  });
}

function sliceAt(slices: Slice[], share: number): Slice {
  const at = Math.min(share * SLICES, SLICES - 1e-6);
  const [a, b, part] = [slices[Math.floor(at)]!, slices[Math.floor(at) + 1]!, at % 1];
  const blend = (p: Point, q: Point): Point => add(scale(p, 1 - part), scale(q, part));
  return {
    centre: blend(a.centre, b.centre),
    radius: a.radius * (1 - part) + b.radius * part,
    right: blend(a.right, b.right),
    up: blend(a.up, b.up),
  };
}
