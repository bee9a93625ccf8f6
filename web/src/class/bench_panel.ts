/** Same picture, different feel: co-contraction of the joint's opposing muscles, and two states to change between. */

import { button, el } from '../app/dom';
import type { App } from '../app/state';
import { isTyping } from '../app/typing';
import { textButton } from '../learn/widgets';

interface Balance {
  common: number;
  difference: number;
}

type Slot = 'a' | 'b';
const SLOTS: readonly Slot[] = ['a', 'b'];

/** At first: at rest, and as much as there is. */
const FIRST: Record<Slot, Balance> = { a: { common: 0, difference: 0 }, b: { common: 1, difference: 0 } };

export class BenchPanel {
  readonly element: HTMLElement;
  private readonly common = range('0');
  private readonly difference = range('-1');
  private readonly kept: Record<Slot, Balance> = { a: { ...FIRST.a }, b: { ...FIRST.b } };
  private readonly feel: Record<Slot, HTMLButtonElement>;
  private readonly note = el('p', { class: 'quiet small', role: 'status' });
  private touched_ms = -Infinity; // when a slider was moved last

  constructor(private readonly app: App) {
    const feel = (slot: Slot) => button('toggle feel', () => this.ask(this.kept[slot]));
    this.feel = { a: feel('a'), b: feel('b') };
    for (const slider of [this.common, this.difference]) slider.addEventListener('input', () => this.slide());
    this.element = el('div', { class: 'bench' }, this.presets(), this.sliders(), this.slots(), this.note, this.scene());
    document.addEventListener('keydown', (event) => this.key(event));
    app.on('inForce', () => this.update());
    app.on('language', () => this.update());
    this.update();
  }

  private presets(): HTMLElement {
    const presets = this.app.scene.co_contraction?.presets ?? [];
    const buttons = presets.map(({ name, common, difference }) => {
      const key = `demonstrate.preset.${name}`;
      const made = textButton(name, 'plain', () => this.ask({ common, difference }));
      if (this.app.texts.has(key)) this.app.texts.bind(made, key);
      if (this.app.texts.has(`${key}.tip`)) this.app.texts.bindAttribute(made, 'title', `${key}.tip`);
      return made;
    });
    return el('div', { class: 'row wrap' }, ...buttons);
  }

  private sliders(): HTMLElement {
    const field = (key: string, slider: HTMLInputElement) =>
      el('label', { class: 'slider' }, this.app.texts.bind(el('span'), key), slider);
    const common = field('learn.common', this.common);
    return el('div', {}, common, field('demonstrate.difference', this.difference));
  }

  private slots(): HTMLElement {
    const { texts } = this.app;
    const column = (slot: Slot) => {
      const keep = texts.bind(
        button('plain', () => this.keep(slot)),
        `demonstrate.store_${slot}`,
      );
      texts.bindAttribute(this.feel[slot], 'title', `web.bench.feel_${slot}.tip`);
      return el('div', { class: 'slot' }, this.feel[slot], keep);
    };
    return el('div', { class: 'row slots' }, ...SLOTS.map(column));
  }

  /** What concerns the scene as a whole. */
  private scene(): HTMLElement {
    const { app } = this;
    const toggle = (key: string, control: string, read: () => boolean) => {
      const made = app.texts.bind(
        button('toggle', () => app.send({ do: control, on: !read() })),
        key,
      );
      const update = () => made.setAttribute('aria-pressed', String(read()));
      app.on('inForce', update);
      update();
      return made;
    };
    const once = (key: string, control: string) =>
      app.texts.bind(
        button('plain', () => app.send({ do: control })),
        key,
      );
    return el(
      'div',
      { class: 'row wrap' },
      toggle('demonstrate.hold_posture', 'hold_posture', () => app.inForce?.hold_posture === true),
      toggle('demonstrate.gravity', 'gravity', () => app.inForce?.gravity === true),
      toggle('toolbar.pause', 'pause', () => app.inForce?.paused === true),
      once('toolbar.reset', 'reset'),
      once('demonstrate.shove', 'shove'),
    );
  }

  private ask(balance: Balance): void {
    this.app.send({ do: 'co_contract', ...balance });
  }

  private get set(): Balance {
    return { common: Number(this.common.value), difference: Number(this.difference.value) };
  }

  private slide(): void {
    this.touched_ms = performance.now();
    this.ask(this.set);
  }

  private keep(slot: Slot): void {
    this.kept[slot] = this.set;
    this.update();
  }

  /** A and B, wherever one is not typing. */
  private key(event: KeyboardEvent): void {
    const slot = SLOTS.find((letter) => letter === event.key.toLowerCase());
    if (!slot || isTyping(event.target) || event.ctrlKey || event.altKey || event.metaKey) return;
    this.ask(this.kept[slot]);
  }

  private update(): void {
    const SETTLE_MS = 400; // until what a slider asked for has come back; before, it must not jump under the hand
    const { inForce, texts } = this.app;
    if (inForce && performance.now() - this.touched_ms > SETTLE_MS) {
      this.common.value = String(inForce.common);
      this.difference.value = String(inForce.difference);
    }
    for (const slot of SLOTS) {
      const { common, difference } = this.kept[slot];
      const near = (a: number, b: number) => Math.abs(a - b) < 0.005;
      const felt = inForce?.drive === 'balance' && near(inForce.common, common) && near(inForce.difference, difference);
      texts.bind(this.feel[slot], `web.bench.feel_${slot}`, 100 * common);
      this.feel[slot].setAttribute('aria-pressed', String(felt === true));
    }
    const led = inForce?.drive === 'script' ? texts.t('web.bench.script') : '';
    if (this.note.textContent !== led) this.note.textContent = led;
  }
}

function range(lowest: string): HTMLInputElement {
  return el('input', { type: 'range', min: lowest, max: '1', step: '0.01', value: '0' });
}
