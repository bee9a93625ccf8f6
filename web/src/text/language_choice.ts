import { el } from '../app/dom';
import type { App } from '../app/state';

/** By code, which is short enough for a phone's bar; each names itself in full. */
export function languageChoice({ texts }: App): HTMLElement {
  const choice = el('select', { class: 'choice' });
  texts.bindAttribute(choice, 'aria-label', 'comfort.language');
  for (const code of texts.languages) {
    const title = texts.t(`comfort.language.${code}`);
    choice.append(el('option', { value: code, lang: code, title, text: code.toUpperCase() }));
  }
  choice.value = texts.language;
  choice.addEventListener('change', () => texts.choose(choice.value));
  return choice;
}
