/**
 * The frame of the page: a bar above, panels at both sides, the limb between them, a line of state below. On a phone the
 * panels are sheets over the lower half, opened by two tabs.
 */
import { button, el } from './dom';
import type { PanelOptions, PanelSide, Texts } from './state';

const TOAST_MS = 5000;

export class Layout {
  readonly element = el('div', { class: 'page' });
  readonly title = el('h1', { class: 'page-title', text: 'Myotact' });
  /** Of modes and sides to look from. */
  readonly bar = el('div', { class: 'bar-middle', role: 'toolbar' });
  readonly tools = el('div', { class: 'bar-tools' });
  readonly middle = el('main', { class: 'middle' });
  readonly over = el('div', { class: 'over' });
  readonly status = el('footer', { class: 'status' });
  private readonly toasts = el('div', { class: 'toasts', role: 'status', 'aria-live': 'polite' });
  private readonly sides: Record<PanelSide, HTMLElement>;
  private readonly tabs: Record<PanelSide, HTMLButtonElement>;

  constructor(private readonly texts: Texts) {
    const header = el('header', { class: 'bar' }, this.title, this.bar, this.tools);
    this.sides = {
      left: texts.bindAttribute(el('aside', { class: 'side side-left' }), 'aria-label', 'web.tab.left'),
      right: texts.bindAttribute(el('aside', { class: 'side side-right' }), 'aria-label', 'web.tab.right'),
    };
    this.tabs = { left: this.tab('left'), right: this.tab('right') };
    const tabs = el('nav', { class: 'tabs' }, this.tabs.left, this.tabs.right);
    this.middle.append(this.over, this.toasts);
    this.element.append(header, this.sides.left, this.middle, this.sides.right, tabs, this.status);
  }

  addPanel(
    side: PanelSide,
    id: string,
    titleKey: string,
    content: HTMLElement,
    options: PanelOptions = {},
  ): () => void {
    const title = this.texts.bind(el('summary', { class: 'panel-title' }), titleKey);
    const panel = el(
      'details',
      { class: 'panel', id: `panel-${id}` },
      title,
      el('div', { class: 'panel-body' }, content),
    );
    panel.open = options.folded !== true;
    panel.style.order = String(options.order ?? 100);
    this.sides[side].append(panel);
    return () => panel.remove();
  }

  reveal(id: string): void {
    for (const side of ['left', 'right'] as const) {
      const panel = this.sides[side].querySelector<HTMLDetailsElement>(`#panel-${id}`);
      if (panel === null) continue;
      panel.open = true;
      this.openSheet(side);
      panel.scrollIntoView({ block: 'nearest' });
    }
  }

  toast(text: string): void {
    const toast = el('div', { class: 'toast', text });
    this.toasts.append(toast);
    setTimeout(() => toast.remove(), TOAST_MS);
  }

  private tab(side: PanelSide): HTMLButtonElement {
    const tab = this.texts.bind(
      button('tab', () => this.openSheet(this.element.dataset['sheet'] === side ? null : side)),
      `web.tab.${side}`,
    );
    tab.setAttribute('aria-expanded', 'false');
    return tab;
  }

  private openSheet(side: PanelSide | null): void {
    if (side === null) delete this.element.dataset['sheet'];
    else this.element.dataset['sheet'] = side;
    for (const each of ['left', 'right'] as const) this.tabs[each].setAttribute('aria-expanded', String(each === side));
  }
}
