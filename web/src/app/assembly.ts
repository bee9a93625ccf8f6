/** Puts the parts of the page together, the same for a class and for a recording. */
import { LimbView } from '../limb/view';
import { Hand, type SendState } from '../touch/hand';
import { feltChip } from '../panels/felt_chip';
import { KeyHand } from '../touch/key_hand';
import { Pointer } from '../touch/pointer';
import { Tone } from '../touch/tone';
import { ModeBar } from './bar';
import type { SceneFacts } from './facts';
import { Keys } from './keys';
import { Layout } from './layout';
import { Legend } from './legend';
import { Page } from './page';
import { mountPanels } from './panels';
import type { Texts } from './state';
import { StatusLine } from './status';

export interface Assembly {
  page: Page;
  view: LimbView;
  hand: Hand;
  /** Mounts what wants a role and a scene. */
  start(sendState: SendState): void;
}

export function assemble(texts: Texts, scene: SceneFacts, lessons: readonly unknown[]): Assembly {
  const layout = new Layout(texts);
  const page = new Page({ texts, scene, lessons, layout });
  const view = new LimbView(page.parts);
  page.view = view;
  let send: SendState = () => undefined;
  const hand = new Hand(page, view, (state) => send(state));
  layout.middle.prepend(view.element);
  document.body.append(layout.element);
  texts.bindAttribute(view.canvas, 'aria-label', 'web.limb.label');
  document.title = `${scene.title || scene.name} - Myotact`;
  document.documentElement.lang = texts.language;
  texts.onChange((language) => (document.documentElement.lang = language));
  return {
    page,
    view,
    hand,
    start: (sendState) => {
      send = sendState;
      const tone = new Tone(page);
      const bar = new ModeBar(page, hand, tone);
      layout.bar.append(bar.element);
      layout.middle.append(new Legend(page).element, feltChip(page));
      layout.status.append(new StatusLine(page).element);
      new Pointer(page, view, hand, () => bar.showDepth());
      new Keys(page, hand);
      new KeyHand(page, view, hand);
      mountPanels(page);
      view.start(page);
    },
  };
}
