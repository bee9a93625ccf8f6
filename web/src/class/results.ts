/** What came of the class's lessons: one line a student and lesson on the page, every step in the file. */

import type { ClassResult } from '../app/state';
import { csvTable } from './csv';

export interface Line {
  client: number;
  name: string;
  lesson: string;
  steps: number; // answered
  points: number;
  of: number; // of the steps so far
}

/** A step that came again, after a break or another try, counts once: as it came last. */
function newestOfEachStep(results: readonly ClassResult[]): ClassResult[] {
  const newest = new Map<string, ClassResult>();
  for (const result of results) newest.set(JSON.stringify([result.client, result.lesson, result.step]), result);
  return [...newest.values()];
}

export function linesOf(results: readonly ClassResult[]): Line[] {
  const lines = new Map<string, Line>();
  for (const { client, name, lesson, points, of } of newestOfEachStep(results)) {
    const key = JSON.stringify([client, lesson]);
    const line = lines.get(key) ?? { client, name, lesson, steps: 0, points: 0, of: 0 };
    lines.set(key, { ...line, name, steps: line.steps + 1, points: line.points + points, of: line.of + of });
  }
  return [...lines.values()].sort((a, b) => a.lesson.localeCompare(b.lesson) || a.name.localeCompare(b.name));
}

export function resultsCsv(results: readonly ClassResult[]): string {
  const rows = newestOfEachStep(results).map((r) => [r.client, r.name, r.lesson, r.step, r.answer, r.points, r.of]);
  return csvTable([['client', 'name', 'lesson', 'step', 'answer', 'points', 'of'], ...rows]);
}
