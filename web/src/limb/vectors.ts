/** Vectors of three numbers, and poses of 3x4 by rows. */
export type Point = [number, number, number];

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1], a[2] + b[2]];
export const subtract = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
export const scale = (a: Point, by: number): Point => [a[0] * by, a[1] * by, a[2] * by];
export const dot = (a: Point, b: Point): number => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a: Point, b: Point): Point => [
  a[1] * b[2] - a[2] * b[1],
  a[2] * b[0] - a[0] * b[2],
  a[0] * b[1] - a[1] * b[0],
];
export const length = (a: Point): number => Math.hypot(a[0], a[1], a[2]);
export const distance = (a: Point, b: Point): number => length(subtract(a, b));
/** Of a vector without length: it as it is. */
export const unit = (a: Point): Point => scale(a, 1 / (length(a) || 1));
export const mix = (a: Point, b: Point, share: number): Point => add(scale(a, 1 - share), scale(b, share));

export function pointAt(numbers: ArrayLike<number>, index: number): Point {
  return [numbers[3 * index]!, numbers[3 * index + 1]!, numbers[3 * index + 2]!];
}

type Pose = ArrayLike<number>;

export function placed(pose: Pose, p: Point): Point {
  const row = (r: number): number => pose[r]! * p[0] + pose[r + 1]! * p[1] + pose[r + 2]! * p[2] + pose[r + 3]!;
  return [row(0), row(4), row(8)];
}

export function turned(pose: Pose, d: Point): Point {
  const row = (r: number): number => pose[r]! * d[0] + pose[r + 1]! * d[1] + pose[r + 2]! * d[2];
  return [row(0), row(4), row(8)];
}

/** Back from the world; the pose is a rotation and a shift. */
export function turnedBack(pose: Pose, d: Point): Point {
  const column = (c: number): number => pose[c]! * d[0] + pose[c + 4]! * d[1] + pose[c + 8]! * d[2];
  return [column(0), column(1), column(2)];
}

export function placedBack(pose: Pose, p: Point): Point {
  return turnedBack(pose, [p[0] - pose[3]!, p[1] - pose[7]!, p[2] - pose[11]!]);
}
