/**
 * Students' answers to the class's questions, as results. The server forgets them with the question; the teacher's page
 * keeps the last that each student gave.
 */
import type { ClassResult, ClassState } from '../app/state';

/** In place of a lesson's key. */
export const QUESTION = 'question';

export class Answers {
  private readonly kept = new Map<string, ClassResult>();

  take({ question, members = [], results = [] }: ClassState): void {
    if (!question) return;
    const number = results.at(-1)?.number ?? 0; // among the results of lessons where it came
    for (const { id: client, name, role, answer } of members) {
      const key = JSON.stringify([question.id, client]);
      if (role !== 'student' || answer === null || this.kept.get(key)?.answer === answer) continue;
      this.kept.delete(key); // the newest come last
      this.kept.set(key, { number, client, name, lesson: QUESTION, step: 0, answer, points: 0, of: 0, question });
    }
  }

  /** Those among the results of lessons, in the order in which all came. */
  among(results: readonly ClassResult[]): ClassResult[] {
    return [...results, ...this.kept.values()].sort((a, b) => a.number - b.number);
  }

  /** Another one whenever an answer came. */
  get newest(): ClassResult | undefined {
    return [...this.kept.values()].at(-1);
  }
}
