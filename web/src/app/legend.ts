/** What the colours of the muscles mean. */
import { FULL_TENSION_N, kindColours, scaleGradient } from '../limb/colours';
import { el, refill } from './dom';
import type { Group } from './facts';
import type { App } from './state';

export class Legend {
  readonly element = el('div', { class: 'legend' });

  constructor(private readonly app: App) {
    app.on('look', () => this.show());
    app.on('language', () => this.show());
    this.show();
  }

  private show(): void {
    const { colour } = this.app.look;
    this.element.hidden = colour === 'own';
    if (colour === 'kind') this.showKinds();
    if (colour === 'activation') this.showScale('see.activation', 100, 'see.percent');
    if (colour === 'tension') this.showScale('see.tension', FULL_TENSION_N, 'see.newton');
  }

  private showKinds(): void {
    const { texts } = this.app;
    const entries = (['flexor', 'extensor', 'other'] as Group[]).map((group) => {
      const patch = el('span', { class: 'patch' });
      patch.style.background = kindColours[group];
      return el('span', { class: 'legend-entry' }, patch, texts.t(`see.${group}`));
    });
    refill(this.element, el('div', { class: 'legend-title', text: texts.t('see.kind') }), ...entries);
  }

  private showScale(titleKey: string, full: number, unitKey: string): void {
    const { texts } = this.app;
    const band = el('div', { class: 'legend-band' });
    band.style.background = scaleGradient();
    const ends = el('div', { class: 'legend-ends' }, el('span', { text: '0' }), el('span', { text: String(full) }));
    const title = `${texts.t(titleKey)} [${texts.t(unitKey)}]`;
    refill(this.element, el('div', { class: 'legend-title', text: title }), band, ends);
  }
}
