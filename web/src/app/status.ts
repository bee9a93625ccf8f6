/** The line below: whether the page is in, who it is, how fast the simulation runs; a broken link over the limb. */
import { el } from './dom';
import { licencesLink } from './licences';
import type { Page } from './page';

const RATES_EVERY_MS = 1000;

export class StatusLine {
  readonly element = el('div', { class: 'status-line' });
  private readonly link = el('span', { class: 'status-link' });
  private readonly rates = el('span', { class: 'status-rates' });
  private readonly banner = el('div', { class: 'banner', role: 'alert' });
  private said: string | null = null;
  private shown_ms = 0;

  constructor(private readonly page: Page) {
    const { texts } = page;
    const note = texts.bind(el('span', { class: 'status-note' }), 'status.not_medical');
    this.element.append(this.link, this.rates, note, licencesLink(texts));
    for (const event of ['connection', 'class', 'me', 'language'] as const) page.on(event, () => this.show());
    page.on('readings', () => this.showRates());
    this.show();
  }

  private show(): void {
    const { connection, texts, me, classState } = this.page;
    this.link.dataset['state'] = connection.state;
    const joined = [me.name, texts.t(`web.role.${me.role}`)];
    if (me.hand < 0 && me.role !== 'viewer') joined.push(texts.t('web.status.no_hand'));
    this.link.textContent =
      connection.state === 'joined' ? joined.join(' · ') : texts.t(`web.status.${connection.state}`);
    const sentence = 'key' in connection ? connection.key : frozen(classState?.frozen, me.role);
    if (sentence === this.said) return; // a screen reader would say it again with every word of the class
    this.said = sentence;
    this.banner.remove();
    if (sentence === null) return;
    texts.bind(this.banner, sentence);
    this.page.mountOver(this.banner);
  }

  private showRates(): void {
    const now_ms = performance.now();
    if (now_ms - this.shown_ms < RATES_EVERY_MS) return;
    this.shown_ms = now_ms;
    const { readings, texts } = this.page;
    if (readings === null) return;
    this.rates.textContent = texts.t('web.status.rates', readings.simulation_hz, readings.time_factor);
  }
}

function frozen(is: boolean | undefined, role: string): string | null {
  return is === true && role !== 'instructor' ? 'web.status.frozen' : null;
}
