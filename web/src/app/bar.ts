/** What a press on the limb does, how deep it goes, from where the limb is seen, and what is drawn. */
import type { Hand } from '../touch/hand';
import { DEPTHS_M } from '../touch/pointer';
import type { Tone } from '../touch/tone';
import { button, el } from './dom';
import type { Colouring, Side } from './look';
import type { Page } from './page';
import type { Mode } from './state';

const modes: Mode[] = ['look', 'touch', 'pull'];
const sides: Side[] = ['lateral', 'medial', 'cranial', 'caudal'];
const colourings: Record<Colouring, string> = {
  own: 'web.colour.own',
  kind: 'see.kind',
  activation: 'see.activation',
  tension: 'see.tension',
};

export class ModeBar {
  readonly element = el('div', { class: 'controls' });
  private readonly modeButtons = new Map<Mode, HTMLButtonElement>();
  private readonly depth = el('input', { type: 'range', class: 'depth' });

  constructor(
    private readonly page: Page,
    private readonly hand: Hand,
    private readonly tone: Tone,
  ) {
    const rest = el('div', { class: 'controls-rest' }, this.depthControl(), this.views(), this.drawing());
    this.element.append(this.modes(), rest);
    page.on('mode', () => this.showMode());
    page.on('me', () => this.showMode());
    this.showMode();
    this.showDepth();
  }

  showDepth(): void {
    this.depth.value = String(1000 * this.hand.wanted_m);
  }

  private modes(): HTMLElement {
    const group = this.group('web.bar.modes', 'segments');
    for (const mode of modes) {
      const choice = button('segment', () => this.page.setMode(mode));
      this.page.texts.bind(choice, `toolbar.${mode}`);
      this.page.texts.bindAttribute(choice, 'title', `toolbar.${mode}.tip`);
      this.modeButtons.set(mode, choice);
      group.append(choice);
    }
    return group;
  }

  private depthControl(): HTMLElement {
    Object.assign(this.depth, { min: 1000 * DEPTHS_M.least, max: 1000 * DEPTHS_M.most, step: 500 * DEPTHS_M.step });
    this.depth.addEventListener('input', () => (this.hand.wanted_m = this.depth.valueAsNumber / 1000));
    const sound = button('toggle', () => {
      const on = sound.getAttribute('aria-pressed') !== 'true';
      sound.setAttribute('aria-pressed', String(on));
      this.tone.turn(on);
    });
    sound.setAttribute('aria-pressed', 'false');
    const { texts } = this.page;
    texts.bindAttribute(texts.bind(sound, 'web.bar.sound'), 'title', 'web.bar.sound.tip');
    const label = el('label', { class: 'depth-label' }, texts.bind(el('span'), 'web.bar.depth'), this.depth);
    return el('div', { class: 'group group-touch' }, label, sound);
  }

  private views(): HTMLElement {
    const group = this.group('web.bar.views', 'segments');
    for (const side of sides) {
      group.append(
        this.page.texts.bind(
          button('segment', () => this.page.camera.showFrom(side)),
          `toolbar.${side}`,
        ),
      );
    }
    return group;
  }

  private drawing(): HTMLElement {
    const group = this.group('web.bar.drawing', 'group');
    group.append(this.colourChoice(), this.labelsToggle());
    return group;
  }

  private colourChoice(): HTMLElement {
    const { texts } = this.page;
    const choice = el('select', { class: 'choice' });
    texts.bindAttribute(choice, 'aria-label', 'see.colours');
    for (const [colour, key] of Object.entries(colourings)) {
      choice.append(texts.bind(el('option', { value: colour }), key));
    }
    choice.addEventListener('change', () => this.page.setLook({ colour: choice.value as Colouring }));
    this.page.on('look', ({ colour }) => (choice.value = colour));
    return choice;
  }

  private labelsToggle(): HTMLElement {
    const toggle = button('toggle', () => this.page.setLook({ labels: !this.page.look.labels }));
    const show = (): void => toggle.setAttribute('aria-pressed', String(this.page.look.labels));
    this.page.on('look', show);
    show();
    return this.page.texts.bind(toggle, 'web.bar.labels');
  }

  private group(labelKey: string, className: string): HTMLElement {
    return this.page.texts.bindAttribute(el('div', { class: className, role: 'group' }), 'aria-label', labelKey);
  }

  /** A page without a hand can look only. */
  private showMode(): void {
    for (const [mode, choice] of this.modeButtons) {
      choice.setAttribute('aria-pressed', String(mode === this.page.mode));
      choice.disabled = mode !== 'look' && this.page.me.hand < 0;
    }
    this.element.dataset['mode'] = this.page.mode;
    if (this.page.me.hand < 0) this.page.setMode('look');
  }
}
