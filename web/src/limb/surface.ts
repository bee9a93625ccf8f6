/**
 * One part of the limb as it is now. A muscle's skin moves with every picture and lies in the world; a bone keeps its
 * shape in the specimen's files and moves with its body's pose.
 */
import type { Part } from '../app/facts';
import type { Mesh } from '../wire/mesh';

export type Point = [number, number, number];

export interface Surface {
  readonly part: Part;
  /** Three vertices each, counter-clockwise from outside. */
  readonly triangles: Uint32Array;
  /** As in the specimen's files. */
  readonly rest_m: Float32Array;
  /** As the newest picture has it: where it is touched. A bone's in its own frame, as all below. */
  newest_m: Float32Array;
  /** On the way there: where it is seen. */
  readonly drawn_m: Float32Array;
  readonly normals: Float32Array;
  /** Body that carries a bone; -1 for a skin. */
  readonly body: number;
  /** Whether any picture told where it is. */
  known: boolean;
  /** Holds all of it. */
  readonly sphere: { centre: Point; radius: number };
}

export function surfaceOf(part: Part, mesh: Mesh): Surface {
  const surface: Surface = {
    part,
    triangles: mesh.triangles,
    rest_m: mesh.positions_m,
    newest_m: mesh.positions_m,
    drawn_m: mesh.positions_m.slice(),
    normals: new Float32Array(mesh.positions_m.length),
    body: mesh.body,
    known: false,
    sphere: { centre: [0, 0, 0], radius: 0 },
  };
  setNormals(surface);
  setSphere(surface);
  return surface;
}

/** Of the drawn vertices, each triangle by its area. */
export function setNormals({ triangles, drawn_m: p, normals }: Surface): void {
  normals.fill(0);
  for (let t = 0; t < triangles.length; t += 3) {
    const a = 3 * triangles[t]!;
    const b = 3 * triangles[t + 1]!;
    const c = 3 * triangles[t + 2]!;
    const ux = p[b]! - p[a]!,
      uy = p[b + 1]! - p[a + 1]!,
      uz = p[b + 2]! - p[a + 2]!;
    const vx = p[c]! - p[a]!,
      vy = p[c + 1]! - p[a + 1]!,
      vz = p[c + 2]! - p[a + 2]!;
    const x = uy * vz - uz * vy,
      y = uz * vx - ux * vz,
      z = ux * vy - uy * vx;
    for (const corner of [a, b, c]) {
      normals[corner]! += x;
      normals[corner + 1]! += y;
      normals[corner + 2]! += z;
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i]!, normals[i + 1]!, normals[i + 2]!) || 1;
    normals[i]! /= length;
    normals[i + 1]! /= length;
    normals[i + 2]! /= length;
  }
}

/** About the middle of the box round the newest vertices. */
export function setSphere({ newest_m: p, sphere }: Surface): void {
  const low: Point = [Infinity, Infinity, Infinity];
  const high: Point = [-Infinity, -Infinity, -Infinity];
  for (let i = 0; i < p.length; i += 3) {
    for (let axis = 0; axis < 3; ++axis) {
      low[axis] = Math.min(low[axis]!, p[i + axis]!);
      high[axis] = Math.max(high[axis]!, p[i + axis]!);
    }
  }
  for (let axis = 0; axis < 3; ++axis) sphere.centre[axis] = (low[axis]! + high[axis]!) / 2;
  sphere.radius = Math.hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]) / 2;
}
