/** Who is there, hands up first. */

import { el } from '../app/dom';
import type { App, Member } from '../app/state';

function inOrder(members: readonly Member[]): Member[] {
  const byName = (a: Member, b: Member) => a.name.localeCompare(b.name) || a.id - b.id;
  return [...members].sort((a, b) => Number(b.hand_up) - Number(a.hand_up) || byName(a, b));
}

function stateText(app: App, { role, hand, hand_up }: Member): string {
  const { texts } = app;
  const words = [texts.t(`web.role.${role}`)];
  if (role !== 'viewer') words.push(texts.t(hand < 0 ? 'web.members.watches' : 'web.members.has_hand'));
  if (hand_up) words.unshift(texts.t('web.members.hand_up'));
  return words.join(', ');
}

/** `answers`: while a question is open, what each has said stands beside the name. */
export function membersView(app: App, members: readonly Member[], answers: boolean): HTMLElement {
  const rows = inOrder(members).map((member) => {
    const name = el('span', { class: 'name', text: member.name || app.texts.t('web.members.nameless', member.id) });
    const state = el('span', { class: 'quiet small', text: stateText(app, member) });
    const answer = el('span', { class: 'said', text: answers ? (member.answer ?? '') : '' });
    return el('li', { class: member.hand_up ? 'up' : undefined }, name, answer, state);
  });
  return el('ul', { class: 'members' }, ...rows);
}
