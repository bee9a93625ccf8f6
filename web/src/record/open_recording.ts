/** What a page needs to begin with a recording in place of a server. */

import type { SceneFacts } from '../app/facts';
import type { App } from '../app/state';
import type { Dictionary } from '../text/texts';
import { Player } from './player';
import { parseRecording } from './recording';
import { timeBar } from './time_bar';

export interface OpenedRecording {
  facts: SceneFacts;
  lessons: unknown[];
  dictionaries: Record<string, Dictionary>;
  shade: Uint8Array;
  player: Player;
  /** Adds the time bar. */
  mount(app: App): void;
}

/** Rejects where the element holds no recording that this page can play. */
export async function openRecording(element: Element): Promise<OpenedRecording> {
  const recording = parseRecording(element.textContent ?? '');
  const player = new Player(recording);
  return {
    facts: recording.scene,
    lessons: [], // a lesson wants a hand, and a recording has none
    dictionaries: recording.dictionaries,
    shade: recording.shade,
    player,
    mount: (app) => {
      app.mountOver(timeBar(app, player));
      app.toast(app.texts.t('web.record.playing'));
    },
  };
}
