/** The licences of what the page is made of: the server has them; an exported page holds them itself. */
import { button, el } from './dom';
import type { Texts } from './state';

/** Of the element in an exported page. */
export const LICENCES_ID = 'licences';

/** As text of a <script> element that nothing in it can end; `fromElement` gives back the text. */
export function toElement(text: string): string {
  return text.replace(/&/g, '&amp;').replace(/</g, '&lt;');
}

export function fromElement(content: string): string {
  return content.replace(/&lt;/g, '<').replace(/&amp;/g, '&');
}

export function licencesLink(texts: Texts): HTMLElement {
  const held = document.getElementById(LICENCES_ID);
  const link =
    held === null
      ? el('a', { href: '/licences.txt', target: '_blank', rel: 'noopener' })
      : button('text-link', () => show(texts, fromElement(held.textContent ?? '')));
  return texts.bind(link, 'web.status.licences');
}

function show(texts: Texts, text: string): void {
  const close = texts.bind(
    button('plain', () => box.close()),
    'web.close',
  );
  const content = el('pre', { class: 'licences', tabindex: '0', text });
  const box = el('dialog', { class: 'dialog' }, content, el('div', { class: 'row end' }, close));
  texts.bindAttribute(box, 'aria-label', 'web.status.licences');
  box.addEventListener('close', () => box.remove());
  document.body.append(box);
  box.showModal();
}
