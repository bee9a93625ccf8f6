import { el } from '../app/dom';

/** Has the browser save a file. */
export function saveFile(name: string, type: string, content: string): void {
  const url = URL.createObjectURL(new Blob([content], { type }));
  const link = el('a', { href: url, download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 60_000); // by then the browser has it
}

/** Letters that file systems refuse become "_". */
export function fileName(stem: string, ending: string): string {
  const plain = stem.replace(/[^\p{L}\p{N}-]+/gu, '_').slice(0, 80) || 'myotact';
  return `${plain}${ending}`;
}

/** The local time as file names have it: 2026-11-28_10-42. */
export function timeStamp(now = new Date()): string {
  const local = new Date(now.getTime() - 60_000 * now.getTimezoneOffset());
  return local.toISOString().slice(0, 16).replace('T', '_').replace(':', '-');
}
