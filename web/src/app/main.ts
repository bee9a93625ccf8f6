/** Begins the page: a class that is joined, or a recording that stands in the page itself. */
import { openRecording } from '../record/open_recording';
import { RECORDING_ID } from '../record/recording';
import { createTexts, LANGUAGES, type Dictionary } from '../text/texts';
import type { SceneFacts } from './facts';
import { el } from './dom';
import { joinClass } from './live';
import { playRecording } from './playing';
import type { Texts } from './state';

async function fetchJson<T>(path: string): Promise<T> {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return (await answer.json()) as T;
}

async function start(): Promise<void> {
  const element = document.getElementById(RECORDING_ID);
  if (element !== null) {
    const recording = await openRecording(element);
    const texts = createTexts(recording.dictionaries);
    return canDraw() ? playRecording(texts, recording) : giveUp(texts.t('web.no_webgl'));
  }
  const [texts, scene, lessons] = await Promise.all([
    liveTexts(),
    fetchJson<SceneFacts>('/scene.json'),
    fetchJson<unknown[]>('/lessons.json'),
  ]);
  return canDraw() ? joinClass(texts, scene, lessons) : giveUp(texts.t('web.no_webgl'));
}

async function liveTexts(): Promise<Texts> {
  const dictionaries = LANGUAGES.map(async (language) => [
    language,
    await fetchJson<Dictionary>(`/languages/${language}.json`),
  ]);
  return createTexts(Object.fromEntries(await Promise.all(dictionaries)) as Record<string, Dictionary>);
}

function canDraw(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  gl?.getExtension('WEBGL_lose_context')?.loseContext();
  return gl !== null;
}

function giveUp(text: string): void {
  document.body.append(el('p', { class: 'fatal', role: 'alert', text }));
}

start().catch((error: unknown) => {
  console.error(error);
  // In one language: there may be no texts.
  giveUp('This page could not begin. Load it again; if that does not help, tell who runs the class.');
});
