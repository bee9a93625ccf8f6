/** Mesh: a skin or a bone as it lies in the specimen's files. */
import { ByteReader, WireError } from './cursor';

export interface Mesh {
  kind: 'skin' | 'bone';
  /** Among its kind. */
  index: number;
  /** Body that carries it; -1 for a skin. */
  body: number;
  /** x, y, z of each vertex in turn. */
  positions_m: Float32Array;
  /** Three vertices a triangle, counter-clockwise from outside. */
  triangles: Uint32Array;
}

export function decodeMesh(payload: Uint8Array): Mesh {
  const reader = new ByteReader(payload);
  const kind = reader.choice(['skin', 'bone'] as const);
  const [index, body, vertices, count] = [reader.u16(), reader.i32(), reader.u32(), reader.u32()];
  if (12 * (vertices + count) !== reader.left) throw new WireError('a mesh of another length than it says');
  const positions_m = reader.floats(3 * vertices);
  const triangles = Uint32Array.from({ length: 3 * count }, reader.u32);
  if (triangles.some((corner) => corner >= vertices)) throw new WireError('a triangle of vertices that are not there');
  return { kind, index, body, positions_m, triangles };
}
