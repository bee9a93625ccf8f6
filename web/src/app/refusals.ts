/** What the page says of an Event, in its own language: the server's sentences are English. */
import type { Event } from '../wire/small';

/** By the value of an Event that refuses, from 1 on. */
const REFUSALS = ['web.refused.instructor', 'web.refused.question', 'web.refused.much', 'web.refused.wrong'];

/** Key and values of the sentence. */
export function sentenceOf({ code, value, text }: Event): [key: string, ...values: string[]] {
  if (code === 'stop') return ['web.net.stopped'];
  const known = REFUSALS[value - 1];
  return known === undefined ? ['web.refused', text] : [known];
}
