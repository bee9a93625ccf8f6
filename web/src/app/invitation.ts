/** What the link that a member opened holds: `http://HOST:PORT/#token=HEX&role=instructor`. */
import { kept } from './storage';
import type { Role } from './state';

export interface Invitation {
  token: string;
  role: Role;
}

const roles: readonly Role[] = ['viewer', 'student', 'instructor'];

/** Reads the fragment and takes it out of the address bar, where others would see it; a reload finds it again. */
export function takeInvitation(): Invitation {
  if (location.hash.length > 1) {
    kept.ofTab.set('invitation', location.hash.slice(1));
    history.replaceState(null, '', location.pathname);
  }
  return parseInvitation(kept.ofTab.get('invitation') ?? '');
}

export function parseInvitation(fragment: string): Invitation {
  const fields = new URLSearchParams(fragment);
  const role = roles.find((known) => known === fields.get('role')) ?? 'student';
  return { token: fields.get('token') ?? '', role };
}
