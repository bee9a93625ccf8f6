/** Asks for a name before the page joins, unless the tab was only loaded again. */
import { utf8Bytes } from '../wire/cursor';
import { MOST_NAME_BYTES } from '../wire/small';
import { el } from './dom';
import { kept } from './storage';
import type { SceneFacts } from './facts';
import type { Role, Texts } from './state';

export function wasLoadedAgain(): boolean {
  const [entry] = performance.getEntriesByType('navigation') as PerformanceNavigationTiming[];
  return entry?.type === 'reload';
}

export async function askName(texts: Texts, scene: SceneFacts, role: Role): Promise<string> {
  const known = kept.ofBrowser.get('name') ?? '';
  if (wasLoadedAgain() && kept.ofTab.get('joined') === 'yes') return known;
  const name = shortened(await dialog(texts, scene, role, known));
  kept.ofBrowser.set('name', name);
  kept.ofTab.set('joined', 'yes');
  return name;
}

function shortened(name: string): string {
  return new TextDecoder().decode(utf8Bytes(name.replace(/\p{Cc}/gu, '').trim(), MOST_NAME_BYTES));
}

function dialog(texts: Texts, scene: SceneFacts, role: Role, known: string): Promise<string> {
  const input = el('input', { id: 'join-name', type: 'text', maxlength: '48', autocomplete: 'nickname', required: '' });
  input.value = known;
  const form = el(
    'form',
    { class: 'join-form', method: 'dialog' },
    el('h2', { text: scene.title || scene.name }),
    texts.bind(el('p', { class: 'quiet' }), `web.join.${role}`),
    texts.bind(el('label', { for: 'join-name' }), 'web.join.name'),
    input,
    texts.bind(el('button', { class: 'primary', type: 'submit' }), 'web.join.go'),
    texts.bind(el('p', { class: 'quiet small' }), 'status.not_medical'),
  );
  const box = el('dialog', { class: 'join' }, form);
  document.body.append(box);
  box.addEventListener('cancel', (event) => event.preventDefault());
  box.showModal();
  return new Promise((resolve) => {
    form.addEventListener('submit', (event) => {
      event.preventDefault();
      if (shortened(input.value) === '') return;
      box.remove();
      resolve(input.value);
    });
  });
}
