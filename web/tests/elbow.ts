/** The canine elbow of the repository, as a lesson sees it. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { Anatomy } from '../src/learn/lesson';

export const REPOSITORY = process.env.MYOTACT_REPOSITORY ?? join(process.cwd(), '..');

interface Named {
  key: string;
  name_en: string;
  name_la: string;
}

export function anatomyOf(specimen: string): Anatomy {
  const file = join(REPOSITORY, 'meshes', specimen, 'specimen.json');
  const { muscles, bones, joints } = JSON.parse(readFileSync(file, 'utf8')) as Record<string, Named[]>;
  const named = (parts: Named[] = []) =>
    parts.map(({ key, name_en, name_la }) => {
      return { key, english: name_en, latin: name_la, synonyms: key === 'ulna' ? ['elbow bone'] : [] };
    });
  return { muscles: named(muscles), bones: named(bones), joints: joints ?? [], hasOpposingMuscles: true };
}

export const elbow = anatomyOf('canine_elbow');

/** Radius and ulna are one body. */
export function bodyOfBone(bone: number): number {
  return [0, 1, 2, 2, 3][bone] ?? -1;
}

/** A lesson whose only step holds these members. */
export function lessonOf(members: object): object {
  const step = { title: 'S', text: 'X', ...members };
  return { schema: 1, key: 'l', title: 'T', scene: 'elbow', steps: [step] };
}
