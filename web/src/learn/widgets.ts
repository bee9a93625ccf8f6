/** Small pieces of the lessons' panel, and the functions that keep them up to date. */

import { button, el } from '../app/dom';

/** An element with what keeps it up to date, called with the readings, five times a second. */
export interface Live {
  element: HTMLElement;
  update(): void;
}

export function textButton(text: string, className: string, onClick: () => void): HTMLButtonElement {
  const made = button(className, onClick);
  made.textContent = text;
  return made;
}

/** Hidden while it has nothing to say. */
export function paragraph(className: string, text: () => string): Live {
  const element = el('p', { class: className || undefined });
  const update = () => {
    const now = text();
    if (element.textContent !== now) element.textContent = now;
    element.hidden = now === '';
  };
  update();
  return { element, update };
}

/** A bar that fills up, with what it means written on it. */
export function shareBar(read: () => { share: number; text: string }): Live {
  const fill = el('div', { class: 'share-fill' });
  const label = el('span', { class: 'share-text' });
  const element = el('div', { class: 'share' }, fill, label);
  const update = () => {
    const { share, text } = read();
    fill.style.width = `${100 * Math.min(1, Math.max(0, share))}%`;
    label.textContent = text;
    element.hidden = text === '';
  };
  update();
  return { element, update };
}

/** A bar of force with the band that is asked for on it. */
export function bandBar(band: { low_N: number; high_N: number }, force_N: () => number): Live {
  const most_N = 1.6 * band.high_N;
  const percent = (newtons: number) => `${100 * Math.min(1, Math.max(0, newtons / most_N))}%`;
  const wanted = el('div', { class: 'band-wanted' });
  wanted.style.left = percent(band.low_N);
  wanted.style.width = percent(band.high_N - band.low_N);
  const now = el('div', { class: 'band-now' });
  const element = el('div', { class: 'band', 'aria-hidden': 'true' }, wanted, now);
  const update = () => {
    now.style.width = percent(force_N());
  };
  update();
  return { element, update };
}

export function pointsText(points: number): string {
  return String(Math.round(points * 100) / 100);
}
