/** A muscle line in hand, dragged along the screen. */
import type { Ray } from '../limb/picking';
import { distance, dot, mix, pointAt, subtract, type Point } from '../limb/vectors';
import type { ToolGrip } from '../wire/tool_state';
import { planePoint } from './press';

export const LINE_STIFFNESS_N_M = 200;

export class Pull {
  private hand_m: Point;

  /** `plane`: normal of the plane that the hand moves in, towards the eye. */
  constructor(
    readonly muscle: number,
    readonly fraction: number,
    private readonly start_m: Point,
    private readonly plane: Point,
  ) {
    this.hand_m = start_m;
  }

  dragTo(ray: Ray): void {
    this.hand_m = planePoint(ray, this.start_m, this.plane) ?? this.hand_m;
  }

  get hand(): Point {
    return this.hand_m;
  }

  grip(): ToolGrip {
    return {
      line: this.muscle,
      body: -1,
      fraction: this.fraction,
      line_stiffness_N_m: LINE_STIFFNESS_N_M,
      body_point_m: [0, 0, 0],
      body_target_m: [0, 0, 0],
      body_stiffness_N_m: 0,
    };
  }
}

/** The place of a line that is nearest, as its share of the arc from origin to insertion; null: no line. */
export function nearestOnLine(line_m: ArrayLike<number>, place: Point): { fraction: number; point_m: Point } | null {
  const points = Array.from({ length: Math.floor(line_m.length / 3) }, (_, i) => pointAt(line_m, i));
  if (points.length < 2) return null;
  let best = { away_m: Infinity, along_m: 0, point_m: points[0]! };
  let before_m = 0;
  points.slice(1).forEach((b, i) => {
    const a = points[i]!;
    const way = subtract(b, a);
    const share = Math.min(1, Math.max(0, dot(subtract(place, a), way) / (dot(way, way) || 1)));
    const point_m = mix(a, b, share);
    const away_m = distance(place, point_m);
    if (away_m < best.away_m) best = { away_m, along_m: before_m + share * distance(a, b), point_m };
    before_m += distance(a, b);
  });
  return { fraction: best.along_m / (before_m || 1), point_m: best.point_m };
}

/** The place of a line at a share of its arc. */
export function pointOnLine(line_m: ArrayLike<number>, fraction: number): Point {
  const points = Array.from({ length: Math.floor(line_m.length / 3) }, (_, i) => pointAt(line_m, i));
  const sizes = points.slice(1).map((point, i) => distance(point, points[i]!));
  let left_m = fraction * sizes.reduce((sum, size) => sum + size, 0);
  for (let i = 0; i < sizes.length; ++i) {
    if (left_m <= sizes[i]! || i === sizes.length - 1)
      return mix(points[i]!, points[i + 1]!, left_m / (sizes[i]! || 1));
    left_m -= sizes[i]!;
  }
  return points[0] ?? [0, 0, 0];
}
