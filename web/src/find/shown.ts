/** Showing, fading, hiding and isolating parts: changes of the page's look. */

import { plainLook, type Look, type Shown } from '../app/look';
import type { App } from '../app/state';

export type State = 'shown' | Shown;

export function stateOf(look: Look, key: string): State {
  if (look.only !== null && !look.only.includes(key)) return 'hidden';
  return look.parts[key] ?? 'shown';
}

export function setState(app: App, key: string, state: State): void {
  const parts = { ...app.look.parts };
  delete parts[key];
  if (state !== 'shown') parts[key] = state;
  const { only } = app.look;
  const isolated = only !== null && state !== 'hidden' && !only.includes(key);
  app.setLook({ parts, only: isolated ? [...only, key] : only });
}

export function isolate(app: App, key: string): void {
  const parts = { ...app.look.parts };
  delete parts[key];
  app.setLook({ only: [key], parts });
}

export function showAll(app: App): void {
  const { parts, only, layers } = plainLook();
  app.setLook({ parts, only, layers });
}

/** Whether everything is shown as it is without anybody's doing. */
export function isPlain({ parts, only, layers }: Look): boolean {
  return only === null && Object.keys(parts).length === 0 && Object.values(layers).every((share) => share === 1);
}
