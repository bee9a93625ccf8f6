/** What came of the class's lessons and questions: a line a student and lesson on the page, every step in the file. */

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

/** When a client's results came: their places in the list. */
interface Span {
  name: string;
  first: number;
  last: number;
}

/**
 * By number of the client, the number that the same student had at first: who came back after a break has another one
 * under the same name. Where results of two of one name come by turns, each number is a student of its own.
 */
function firstNumbers(results: readonly ClassResult[]): Map<number, number> {
  const spans = new Map<number, Span>();
  results.forEach(({ client, name }, place) => {
    spans.set(client, { name, first: spans.get(client)?.first ?? place, last: place });
  });
  const byName = new Map<string, [number, Span][]>();
  for (const [client, span] of spans) byName.set(span.name, [...(byName.get(span.name) ?? []), [client, span]]);
  const firsts = new Map<number, number>();
  for (const [name, clients] of byName) {
    const inTurn = clients.every(([, { first }], i) => first > (clients[i - 1]?.[1].last ?? -1));
    const same = name !== '' && inTurn;
    for (const [client] of clients) firsts.set(client, same ? (clients[0]?.[0] ?? client) : client);
  }
  return firsts;
}

/**
 * A step that came again, after another try or from a student that came back under another number, counts once: as it
 * came last.
 */
function newestOfEachStep(results: readonly ClassResult[]): ClassResult[] {
  const firsts = firstNumbers(results);
  const newest = new Map<string, ClassResult>();
  for (const result of results) {
    const client = firsts.get(result.client) ?? result.client;
    const key = JSON.stringify([client, result.lesson, result.step, result.question?.id]);
    newest.set(key, { ...result, client });
  }
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
  const rows = newestOfEachStep(results).map((result) => {
    const { client, name, lesson, step, answer, points, of, question } = result;
    return [client, name, lesson, step, answer, points, of, question?.text ?? ''];
  });
  return csvTable([['client', 'name', 'lesson', 'step', 'answer', 'points', 'of', 'question'], ...rows]);
}
