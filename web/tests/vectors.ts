/** The frames of `tests/net/vectors`, which every side of the wire reads and writes. */
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { parseFrame, type Frame } from '../src/wire/frame';

const folder = join(process.env['MYOTACT_REPOSITORY'] ?? '..', 'tests/net/vectors');

interface Entry {
  file: string;
  type: string;
  flags: number;
  sequence: number;
  time_ns: number;
  fields: Record<string, unknown>;
}

const entries = JSON.parse(readFileSync(join(folder, 'manifest.json'), 'utf8')) as Entry[];

export interface Vector {
  bytes: Uint8Array;
  frame: Frame;
  fields: Record<string, unknown>;
}

export function vector(name: string): Vector {
  const entry = entries.find(({ file }) => file === `${name}.bin`);
  if (entry === undefined) throw new Error(`no vector ${name}`);
  const bytes = new Uint8Array(readFileSync(join(folder, entry.file)));
  return { bytes, frame: parseFrame(bytes), fields: entry.fields };
}

export const allVectors = (): { entry: Entry; bytes: Uint8Array }[] =>
  entries.map((entry) => ({ entry, bytes: new Uint8Array(readFileSync(join(folder, entry.file))) }));
