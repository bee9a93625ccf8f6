/** The link for students, as text and as a QR code to point a phone at. */

import { button, el, refill } from '../app/dom';
import { takeInvitation } from '../app/invitation';
import type { App } from '../app/state';
import { textButton } from '../learn/widgets';
import { qrPicture } from './qr';

/** An address that means another computer on every computer. */
function isLocal(host: string): boolean {
  return ['localhost', '127.0.0.1', '[::1]'].includes(host);
}

/** As the server says it. The page knows its own token only, which is the teacher's and must not get about. */
function studentLink({ classState }: App): string {
  return classState?.join ?? (takeInvitation().token === '' ? `${location.origin}/` : '');
}

function parsed(link: string): URL | null {
  try {
    return new URL(link);
  } catch {
    return null;
  }
}

/** What is wrong with a link, as the key of a sentence. */
function complaintOf(link: string): string | null {
  const url = parsed(link);
  if (!url?.protocol.startsWith('http')) return 'web.join.no_link';
  const { token } = takeInvitation();
  if (token !== '' && link.includes(token)) return 'web.join.secret';
  return isLocal(url.hostname) ? 'web.join.local' : null;
}

export function joinButton(app: App): HTMLButtonElement {
  return app.texts.bind(
    button('plain', () => openJoinDialog(app)),
    'web.join.title',
  );
}

function openJoinDialog(app: App): void {
  const { texts } = app;
  const dialog = el('dialog', { class: 'dialog invite' });
  const input = el('input', { type: 'url', spellcheck: 'false', autocomplete: 'off' });
  input.value = studentLink(app);
  const code = el('div', { class: 'qr' });
  const warning = el('p', { class: 'warning', role: 'status' });
  const copy = textButton(texts.t('web.join.copy'), 'plain', () => {
    copyText(input).then(
      () => app.toast(texts.t('web.join.copied')),
      () => app.toast(texts.t('web.join.not_copied')),
    );
  });
  const show = () => {
    const link = input.value.trim();
    const complaint = complaintOf(link);
    const usable = complaint === null || complaint === 'web.join.local';
    refill(code, ...(usable ? [qrPicture(link, texts.t('web.join.code'))] : []));
    copy.disabled = !usable;
    warning.hidden = complaint === null;
    warning.textContent = complaint === null ? '' : texts.t(complaint);
  };
  input.addEventListener('input', show);
  show();
  const close = textButton(texts.t('web.close'), 'primary', () => dialog.close());
  const field = el('label', { class: 'field' }, texts.t('web.join.link'), input);
  const title = el('h2', { text: texts.t('web.join.title') });
  dialog.append(title, el('p', { text: texts.t('web.join.how') }), code, field, warning);
  dialog.append(el('div', { class: 'row end' }, copy, close));
  dialog.addEventListener('close', () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

/** Pages without https have no clipboard: there the link is selected, to be copied by keyboard. */
async function copyText(input: HTMLInputElement): Promise<void> {
  if (navigator.clipboard) return navigator.clipboard.writeText(input.value.trim());
  input.select();
  throw new Error('no clipboard');
}
