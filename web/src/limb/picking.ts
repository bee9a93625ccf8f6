/**
 * What a ray hits, and what of the skins lies nearest to a place. Spheres round the parts leave few triangles to try;
 * bones are asked in their own frame.
 */
import type { Surface } from './surface';
import {
  add,
  cross,
  distance,
  dot,
  mix,
  placed,
  placedBack,
  pointAt,
  scale,
  subtract,
  turned,
  turnedBack,
  unit,
} from './vectors';
import type { Point } from './vectors';

/** Surfaces and where the bones' bodies are: the limb now, or as it was. */
export interface Limb {
  readonly surfaces: readonly (Surface | undefined)[];
  newestPose(body: number): Float32Array;
}

export interface Hit {
  surface: Surface;
  triangle: number;
  barycentric: Point;
  point_m: Point;
  /** Out of the part. */
  normal: Point;
  /** Along the ray, or from the place. */
  distance_m: number;
}

export interface Ray {
  origin_m: Point;
  /** Unit length. */
  direction: Point;
}

type Wanted = (surface: Surface) => boolean;

export function raycast(limb: Limb, ray: Ray, wanted: Wanted): Hit | null {
  let best: Hit | null = null;
  for (const surface of limb.surfaces) {
    if (surface === undefined || !surface.known || !wanted(surface)) continue;
    const hit = hitOf(limb, surface, ray, best?.distance_m ?? Infinity);
    if (hit !== null) best = hit;
  }
  return best;
}

function hitOf(limb: Limb, surface: Surface, world: Ray, most_m: number): Hit | null {
  const pose = surface.body < 0 ? null : limb.newestPose(surface.body);
  const ray = pose === null ? world : rayIn(pose, world);
  if (!meetsSphere(surface.sphere, ray, most_m)) return null;
  const found = nearestTriangle(surface, ray, most_m);
  if (found === null) return null;
  const { triangle, barycentric, distance_m } = found;
  const point_m = add(world.origin_m, scale(world.direction, distance_m));
  const normal = normalAt(surface, triangle);
  return { surface, triangle, barycentric, distance_m, point_m, normal: pose === null ? normal : turned(pose, normal) };
}

function rayIn(pose: Float32Array, ray: Ray): Ray {
  return { origin_m: placedBack(pose, ray.origin_m), direction: turnedBack(pose, ray.direction) };
}

function meetsSphere({ centre, radius }: Surface['sphere'], { origin_m, direction }: Ray, most_m: number): boolean {
  const way = subtract(centre, origin_m);
  const along = dot(way, direction);
  return along > -radius && along - radius < most_m && dot(way, way) - along * along <= radius * radius;
}

interface TriangleHit {
  triangle: number;
  barycentric: Point;
  distance_m: number;
}

/** Möller and Trumbore (1997), front sides only; written out, since it runs thousands of times a click. */
function nearestTriangle(surface: Surface, { origin_m: o, direction: d }: Ray, most_m: number): TriangleHit | null {
  const { triangles, newest_m: p } = surface;
  let best_m = most_m;
  let best: TriangleHit | null = null;
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t]!,
      b = 3 * triangles[t + 1]!,
      c = 3 * triangles[t + 2]!;
    const ux = p[b]! - p[a]!,
      uy = p[b + 1]! - p[a + 1]!,
      uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!,
      vy = p[c + 1]! - p[a + 1]!,
      vz = p[c + 2]! - p[a + 2]!;
    const qx = d[1] * vz - d[2] * vy,
      qy = d[2] * vx - d[0] * vz,
      qz = d[0] * vy - d[1] * vx;
    const size = ux * qx + uy * qy + uz * qz;
    if (size <= 0) continue;
    const sx = o[0] - p[a]!,
      sy = o[1] - p[a + 1]!,
      sz = o[2] - p[a + 2]!;
    const second = (sx * qx + sy * qy + sz * qz) / size;
    if (second < 0 || second > 1) continue;
    const rx = sy * uz - sz * uy,
      ry = sz * ux - sx * uz,
      rz = sx * uy - sy * ux;
    const third = (d[0] * rx + d[1] * ry + d[2] * rz) / size;
    if (third < 0 || second + third > 1) continue;
    const along_m = (vx * rx + vy * ry + vz * rz) / size;
    if (along_m <= 0 || along_m >= best_m) continue;
    best_m = along_m;
    best = { triangle: t / 3, barycentric: [1 - second - third, second, third], distance_m: along_m };
  }
  return best;
}

/** The limb as it is now, whatever comes. */
export function snapshotOf(limb: Limb): Limb {
  const surfaces = limb.surfaces.map((surface) => {
    return surface && { ...surface, normals: surface.normals.slice(), sphere: structuredClone(surface.sphere) };
  });
  const poses = new Map(surfaces.map((surface) => [surface?.body ?? -1, limb.newestPose(surface?.body ?? -1)]));
  return { surfaces, newestPose: (body) => poses.get(body) ?? limb.newestPose(body) };
}

/** Of a hit, from the normals of its triangle's corners: what slides over edges feels none. */
export function smoothNormal(limb: Limb, { surface, triangle, barycentric, normal }: Hit): Point {
  let sum: Point = [0, 0, 0];
  barycentric.forEach((weight, i) => {
    sum = add(sum, scale(pointAt(surface.normals, surface.triangles[3 * triangle + i]!), weight));
  });
  const smooth = unit(surface.body < 0 ? sum : turned(limb.newestPose(surface.body), sum));
  return dot(smooth, normal) > LEAST_SMOOTH ? smooth : normal;
}

/** Cosine: at a crease the corners' normals say nothing of the triangle. */
const LEAST_SMOOTH = 0.3;

export function cornersOf(surface: Surface, triangle: number): [Point, Point, Point] {
  const corner = (i: number): Point => pointAt(surface.newest_m, surface.triangles[3 * triangle + i]!);
  return [corner(0), corner(1), corner(2)];
}

function normalAt(surface: Surface, triangle: number): Point {
  const [a, b, c] = cornersOf(surface, triangle);
  return unit(cross(subtract(b, a), subtract(c, a)));
}

/** What a search for the nearest place may find: only what looks along `facing` at least a little, within reach. */
export interface Search {
  place_m: Point;
  reach_m: number;
  facing: Point;
}

/** The place of the wanted surfaces that is nearest; null: none within reach. */
export function nearest(limb: Limb, search: Search, wanted: Wanted): Hit | null {
  let best: Hit | null = null;
  let reach_m = search.reach_m;
  for (const surface of limb.surfaces) {
    if (surface === undefined || !surface.known || !wanted(surface)) continue;
    const hit = nearestOn(limb, surface, { ...search, reach_m });
    if (hit === null) continue;
    best = hit;
    reach_m = hit.distance_m;
  }
  return best;
}

function nearestOn(limb: Limb, surface: Surface, world: Search): Hit | null {
  const pose = surface.body < 0 ? null : limb.newestPose(surface.body);
  const place = pose === null ? world.place_m : placedBack(pose, world.place_m);
  const facing = pose === null ? world.facing : turnedBack(pose, world.facing);
  if (distance(place, surface.sphere.centre) > surface.sphere.radius + world.reach_m) return null;
  let reach_m = world.reach_m;
  let best: Hit | null = null;
  for (let triangle = 0; triangle < surface.triangles.length / 3; ++triangle) {
    if (!mayBeNearer(surface, triangle, place, reach_m)) continue;
    const corners = cornersOf(surface, triangle);
    const normal = unit(cross(subtract(corners[1], corners[0]), subtract(corners[2], corners[0])));
    if (dot(normal, facing) <= LEAST_FACING) continue;
    const barycentric = closestOnTriangle(place, corners);
    const point = weighted(corners, barycentric);
    const distance_m = distance(point, place);
    if (distance_m >= reach_m) continue;
    reach_m = distance_m;
    best = {
      surface,
      triangle,
      barycentric,
      distance_m,
      point_m: pose === null ? point : placed(pose, point),
      normal: pose === null ? normal : turned(pose, normal),
    };
  }
  return best;
}

/** Cosine; steeper sides of a dent still count, the far side of a thin muscle does not. */
const LEAST_FACING = 0.1;

/** By the box round the triangle. */
function mayBeNearer(surface: Surface, triangle: number, place: Point, reach_m: number): boolean {
  const { triangles, newest_m: p } = surface;
  const a = 3 * triangles[3 * triangle]!,
    b = 3 * triangles[3 * triangle + 1]!,
    c = 3 * triangles[3 * triangle + 2]!;
  for (let axis = 0; axis < 3; ++axis) {
    const x = p[a + axis]!,
      y = p[b + axis]!,
      z = p[c + axis]!;
    if (Math.min(x, y, z) > place[axis]! + reach_m || Math.max(x, y, z) < place[axis]! - reach_m) return false;
  }
  return true;
}

export function weighted(corners: [Point, Point, Point], weights: Point): Point {
  return add(add(scale(corners[0], weights[0]), scale(corners[1], weights[1])), scale(corners[2], weights[2]));
}

/** Barycentric coordinates of the triangle's point that is nearest (Ericson, Real-Time Collision Detection, 5.1.5). */
export function closestOnTriangle(place: Point, [a, b, c]: [Point, Point, Point]): Point {
  const ab = subtract(b, a),
    ac = subtract(c, a);
  const ap = subtract(place, a);
  const d1 = dot(ab, ap),
    d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return [1, 0, 0];
  const bp = subtract(place, b);
  const d3 = dot(ab, bp),
    d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return [0, 1, 0];
  const vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0) return mix([1, 0, 0], [0, 1, 0], d1 / (d1 - d3));
  const cp = subtract(place, c);
  const d5 = dot(ab, cp),
    d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return [0, 0, 1];
  const vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0) return mix([1, 0, 0], [0, 0, 1], d2 / (d2 - d6));
  const va = d3 * d6 - d5 * d4;
  const [e, f] = [d4 - d3, d5 - d6];
  if (va <= 0 && e >= 0 && f >= 0) return mix([0, 1, 0], [0, 0, 1], e / (e + f));
  const whole = va + vb + vc;
  return [va / whole, vb / whole, vc / whole];
}
