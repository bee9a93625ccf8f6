import { utf8Bytes } from '../wire/cursor';

/** As one line of at most so many bytes of UTF-8, cut between letters. */
export function shortLine(text: string, most_bytes: number): string {
  const line = text.replace(/\p{Cc}+/gu, ' ').trim();
  return new TextDecoder().decode(utf8Bytes(line, most_bytes)).trim();
}
