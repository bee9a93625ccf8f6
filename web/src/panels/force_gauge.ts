/** The force on the hand as number and bar, and what is touched or held. */
import { el } from '../app/dom';
import type { App, Touch } from '../app/state';

const FULL_N = 3;

export class ForceGauge {
  readonly element = el('div', { class: 'gauge' });
  private readonly number = el('output', { class: 'big-number' });
  private readonly fill = el('div', { class: 'gauge-fill' });
  private readonly what = el('p', { class: 'quiet' });
  private readonly bar = el('div', { class: 'gauge-bar', role: 'meter', 'aria-valuemin': '0' }, this.fill);

  constructor(private readonly app: App) {
    this.bar.setAttribute('aria-valuemax', String(FULL_N));
    app.texts.bindAttribute(this.bar, 'aria-label', 'web.felt.title');
    this.element.append(this.number, this.bar, this.what);
    app.on('touch', (touch) => this.show(touch));
    for (const event of ['language', 'mode', 'me'] as const) app.on(event, () => this.show(app.touch));
    this.show(app.touch);
  }

  private show(touch: Touch): void {
    this.number.textContent = `${touch.force_N.toFixed(2)} N`;
    this.fill.style.width = `${(100 * Math.min(1, touch.force_N / FULL_N)).toFixed(1)}%`;
    this.bar.setAttribute('aria-valuenow', touch.force_N.toFixed(2));
    this.what.textContent = this.sentence(touch);
  }

  private sentence({ part, line, tension_N }: Touch): string {
    const { texts, me, mode } = this.app;
    const name = (key: string): string => (this.app.look.names === 'none' ? '?' : this.app.nameOf(key));
    if (me.hand < 0) return texts.t('web.felt.no_hand');
    if (line !== null) return texts.t('feel.holds_line', name(line), tension_N);
    if (part !== null)
      return texts.t(this.app.part(part)?.kind === 'bone' ? 'feel.touches_bone' : 'feel.touches', name(part));
    return texts.t(`web.felt.${mode}`);
  }
}
