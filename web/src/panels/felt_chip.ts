/** The felt force over the limb, for pages whose gauge is folded away. */
import { el } from '../app/dom';
import type { App } from '../app/state';

export function feltChip(app: App): HTMLElement {
  const chip = el('output', { class: 'felt-chip', hidden: '' });
  app.on('touch', ({ part, line, force_N }) => {
    chip.hidden = part === null && line === null;
    chip.textContent = `${force_N.toFixed(2)} N`;
  });
  return chip;
}
