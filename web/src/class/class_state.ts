/** Reads what the server says of the class; what it does not say, or says in another shape, is as in an empty class. */

import type { ClassResult, ClassState, Member, Question, Role } from '../app/state';

const ROLES: readonly Role[] = ['viewer', 'student', 'instructor'];

type Fields = Record<string, unknown>;

function fieldsOf(value: unknown): Fields {
  return typeof value === 'object' && value !== null ? (value as Fields) : {};
}

function listOf(value: unknown): unknown[] {
  return Array.isArray(value) ? value : [];
}

function textOf(value: unknown): string {
  return typeof value === 'string' ? value : '';
}

function numberOf(value: unknown, otherwise = 0): number {
  return typeof value === 'number' ? value : otherwise;
}

function questionOf(value: unknown): Question | null {
  const { id, text, options } = fieldsOf(value);
  const known = listOf(options).filter((option) => typeof option === 'string');
  return typeof id === 'string' && known.length > 0 ? { id, text: textOf(text), options: known } : null;
}

function memberOf(value: unknown, handsUp: readonly unknown[]): Member {
  const { id, name, role, hand, answer } = fieldsOf(value);
  return {
    id: numberOf(id),
    name: textOf(name),
    role: ROLES.find((known) => known === role) ?? 'viewer',
    hand: numberOf(hand, -1),
    hand_up: handsUp.includes(id),
    answer: typeof answer === 'string' ? answer : null,
  };
}

function resultOf(value: unknown): ClassResult {
  const { number, client, name, lesson, step, answer, points, of } = fieldsOf(value);
  return {
    number: numberOf(number),
    client: numberOf(client),
    name: textOf(name),
    lesson: textOf(lesson),
    step: numberOf(step),
    answer: textOf(answer),
    points: numberOf(points),
    of: numberOf(of),
  };
}

/** What a class of an afternoon comes to, and a page can draw at once. */
export const MOST_RESULTS = 5000;

/** The server says only the newest results again: the older ones are kept here, unless it has begun to count anew. */
function allResults(newest: ClassResult[], before: readonly ClassResult[]): ClassResult[] {
  const last = newest.at(-1)?.number ?? 0;
  const known = (before.at(-1)?.number ?? 0) > last ? [] : before;
  const first = newest[0]?.number ?? 0;
  return [...known.filter(({ number }) => number < first), ...newest].slice(-MOST_RESULTS);
}

/** `client`: this page's own number; `before`: what was known until now. */
export function readClassState(message: unknown, client: number, before: ClassState | null): ClassState {
  const { frozen, look, question, lesson, students, hands_up, join, members, results } = fieldsOf(message);
  const handsUp = listOf(hands_up);
  const state: ClassState = {
    frozen: frozen === true,
    look: look ?? null,
    question: questionOf(question),
    lesson: typeof lesson === 'string' ? lesson : null,
    students: numberOf(students),
    you: { hand_up: handsUp.includes(client) },
  };
  if (typeof join === 'string') state.join = join;
  if (members !== undefined) state.members = listOf(members).map((member) => memberOf(member, handsUp));
  if (results !== undefined) state.results = allResults(listOf(results).map(resultOf), before?.results ?? []);
  return state;
}
