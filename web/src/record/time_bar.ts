/** Below a recording: play, pause, and any moment of it. */

import { button, el } from '../app/dom';
import type { App } from '../app/state';
import type { Player } from './player';

const STEP_S = 0.05;

function clockText(time_s: number): string {
  const seconds = Math.floor(time_s);
  return `${Math.floor(seconds / 60)}:${String(seconds % 60).padStart(2, '0')}`;
}

export function timeBar(app: App, player: Player): HTMLElement {
  const toggle = button('primary', () => (player.playing ? player.pause() : player.play()));
  const range = { min: '0', max: String(player.length_s), step: String(STEP_S) };
  const slider = el('input', { type: 'range', ...range });
  app.texts.bindAttribute(slider, 'aria-label', 'web.record.time');
  const time = el('span', { class: 'time' });
  slider.addEventListener('input', () => {
    const wanted_s = Number(slider.value); // pausing shows the time of now
    player.pause();
    player.seek(wanted_s);
  });
  let shown: boolean | null = null;
  const update = () => {
    slider.value = String(player.time_s);
    slider.setAttribute('aria-valuetext', clockText(player.time_s));
    time.textContent = `${clockText(player.time_s)} / ${clockText(player.length_s)}`;
    if (shown !== player.playing) {
      shown = player.playing;
      app.texts.bind(toggle, shown ? 'keep.replay_pause' : 'keep.replay_play');
    }
  };
  player.onChange(update);
  update();
  return el('div', { class: 'time-bar row' }, toggle, slider, time);
}
