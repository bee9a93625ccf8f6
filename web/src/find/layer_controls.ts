/** How solid the layers are drawn. */

import { el } from '../app/dom';
import type { Look } from '../app/look';
import type { App } from '../app/state';

type Layer = keyof Look['layers'];
const LAYERS: readonly Layer[] = ['superficial', 'deep', 'bones'];

export class LayerControls {
  readonly element: HTMLElement;

  constructor(app: App) {
    this.element = el('div', { class: 'layers' }, ...LAYERS.map((layer) => slider(app, layer)));
  }
}

function slider(app: App, layer: Layer): HTMLElement {
  const input = el('input', { type: 'range', min: '0', max: '1', step: '0.05' });
  const show = ({ layers }: Look) => {
    input.value = String(layers[layer]);
    input.setAttribute('aria-valuetext', `${Math.round(100 * layers[layer])} %`);
  };
  input.addEventListener('input', () => app.setLook({ layers: { ...app.look.layers, [layer]: Number(input.value) } }));
  app.on('look', show);
  show(app.look);
  return el('label', { class: 'slider' }, app.texts.bind(el('span'), `see.${layer}`), input);
}
