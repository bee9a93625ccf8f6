/**
 * A ball pressed into the limb. The hand strokes over the limb as it was when the press began, so that a dent does not
 * draw it deeper and deeper, and lies below that by its depth; the tissue under the ball is the place of the part's skin
 * now that is nearest to its centre, and a spring couples the two.
 */
import { nearest, raycast, smoothNormal, snapshotOf, type Hit, type Limb, type Ray } from '../limb/picking';
import type { Surface } from '../limb/surface';
import { add, dot, scale, subtract, type Point } from '../limb/vectors';
import type { ToolContact } from '../wire/tool_state';

export const RADIUS_M = 0.003;
/** Soft beside what a device renders: the hand is a pointer without feeling, and the tissue should win. */
export const STIFFNESS_N_M = 300;
/** So slow that the tissue is seen to give. */
const RATE_M_S = 0.02;
/** How far from the ball tissue may be and still bear it; a dent is wider than the ball is deep. */
const REACH_M = 0.03;

export interface Felt {
  tool_m: Point;
  proxy_m: Point;
  force_N: Point;
  contact: ToolContact | null;
  surface: Surface | null;
}

export class Press {
  private readonly before: Limb;
  /** Of the limb as it was; null: the pointer slid off it. */
  private hit: Hit | null;
  private anchor_m: Point;
  private normal: Point;
  private depth_m = 0;

  constructor(
    private readonly limb: Limb,
    hit: Hit,
    private readonly wanted: (surface: Surface) => boolean,
  ) {
    this.before = snapshotOf(limb);
    this.hit = hit;
    this.anchor_m = hit.point_m;
    this.normal = smoothNormal(limb, hit);
  }

  strokeTo(ray: Ray): void {
    this.hit = raycast(this.before, ray, this.wanted);
    if (this.hit === null) {
      this.anchor_m = planePoint(ray, this.anchor_m, scale(ray.direction, -1)) ?? this.anchor_m;
      return;
    }
    this.anchor_m = this.hit.point_m;
    this.normal = smoothNormal(this.before, this.hit);
  }

  get depth(): number {
    return this.depth_m;
  }

  /** One step of the hand towards the depth that is wanted. */
  advance(wanted_m: number, seconds: number): void {
    const step_m = RATE_M_S * seconds;
    this.depth_m += Math.max(-2 * step_m, Math.min(step_m, wanted_m - this.depth_m));
  }

  feel(): Felt {
    const tool_m = add(this.anchor_m, scale(this.normal, RADIUS_M - this.depth_m));
    const under = this.hit?.surface.part;
    const search = { place_m: tool_m, reach_m: REACH_M, facing: this.normal };
    const hit = under === undefined ? null : nearest(this.limb, search, (surface) => surface.part === under);
    if (hit === null) return free(tool_m);
    const normal = smoothNormal(this.limb, hit);
    if (dot(subtract(tool_m, hit.point_m), normal) >= RADIUS_M) return free(tool_m);
    const proxy_m = add(hit.point_m, scale(normal, RADIUS_M));
    return {
      tool_m,
      proxy_m,
      force_N: scale(subtract(proxy_m, tool_m), STIFFNESS_N_M),
      contact: contactOf(hit, normal, subtract(tool_m, scale(normal, RADIUS_M))),
      surface: hit.surface,
    };
  }
}

function free(tool_m: Point): Felt {
  return { tool_m, proxy_m: tool_m, force_N: [0, 0, 0], contact: null, surface: null };
}

function contactOf(hit: Hit, normal: Point, target_m: Point): ToolContact {
  const [first, second] = hit.barycentric;
  return {
    surface: hit.surface.part.surface,
    triangle: hit.triangle,
    barycentric: [first, second, 1 - first - second],
    normal,
    target_m,
    stiffness_N_m: STIFFNESS_N_M,
    touched_m: hit.point_m,
  };
}

/** Where a ray meets a plane in front of the eye. */
export function planePoint(ray: Ray, through_m: Point, normal: Point): Point | null {
  const slope = dot(ray.direction, normal);
  if (Math.abs(slope) < 1e-6) return null;
  const along_m = dot(subtract(through_m, ray.origin_m), normal) / slope;
  return along_m > 0 ? add(ray.origin_m, scale(ray.direction, along_m)) : null;
}
