/** A question to the class: what may be asked, and how many gave which answer. */

import type { Member, Question } from '../app/state';
import { shortLine } from '../text/short_line';

export const FEWEST_OPTIONS = 2;
export const MOST_OPTIONS = 6;
export const LONGEST_TEXT = 400; // bytes, as the server takes them
export const LONGEST_OPTION = 100;

/** Null where the text is empty or fewer than two different options are given. */
export function makeQuestion(id: string, text: string, options: readonly string[]): Question | null {
  const asked = shortLine(text, LONGEST_TEXT);
  const named = options.map((option) => shortLine(option, LONGEST_OPTION)).filter((option) => option !== '');
  const distinct = [...new Set(named)].slice(0, MOST_OPTIONS);
  return asked === '' || distinct.length < FEWEST_OPTIONS ? null : { id, text: asked, options: distinct };
}

/** Unlike any other of this class; randomUUID() is not there on pages without https. */
export function newQuestionId(): string {
  const numbers = crypto.getRandomValues(new Uint32Array(2));
  return [...numbers].map((number) => number.toString(16).padStart(8, '0')).join('');
}

export interface Count {
  option: string;
  students: number;
  share: number; // of those who answered
}

/** Of students only: others may answer to try it out. */
export function countAnswers(question: Question, members: readonly Member[]): Count[] {
  const answers = members.filter(({ role }) => role === 'student').map(({ answer }) => answer);
  const valid = answers.filter((answer) => answer !== null && question.options.includes(answer));
  return question.options.map((option) => {
    const students = valid.filter((answer) => answer === option).length;
    return { option, students, share: valid.length === 0 ? 0 : students / valid.length };
  });
}
