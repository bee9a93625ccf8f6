/** Begins the page: a class that is joined, or a recording that stands in the page itself. */
import { openRecording } from '../record/open_recording';
import { createTexts, LANGUAGES, type Dictionary } from '../text/texts';
import type { SceneFacts } from './facts';
import { el } from './dom';
import { joinClass } from './live';
import { playRecording } from './playing';
import type { Texts } from './state';

const RECORDING_ID = 'recording';

async function fetchJson<T>(path: string): Promise<T> {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return (await answer.json()) as T;
}

async function start(): Promise<void> {
  const element = document.getElementById(RECORDING_ID);
  if (element !== null) return playRecording(await openRecording(element));
  const [texts, scene, lessons] = await Promise.all([
    liveTexts(),
    fetchJson<SceneFacts>('/scene.json'),
    fetchJson<unknown[]>('/lessons.json'),
  ]);
  await joinClass(texts, scene, lessons);
}

async function liveTexts(): Promise<Texts> {
  const dictionaries = LANGUAGES.map(async (language) => [
    language,
    await fetchJson<Dictionary>(`/languages/${language}.json`),
  ]);
  return createTexts(Object.fromEntries(await Promise.all(dictionaries)) as Record<string, Dictionary>);
}

start().catch((error: unknown) => {
  console.error(error);
  // In one language: there may be no texts.
  const text = 'This page could not begin. Load it again; if that does not help, tell who runs the class.';
  document.body.append(el('p', { class: 'fatal', role: 'alert', text }));
});
