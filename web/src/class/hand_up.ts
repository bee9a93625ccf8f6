import { button } from '../app/dom';
import type { App } from '../app/state';

/** A student's hand: up until the student takes it down. */
export function handUpButton(app: App): HTMLButtonElement {
  const isUp = () => app.classState?.you.hand_up === true;
  const toggle = button('toggle', () => app.send({ do: 'class_hand_up', on: !isUp() }));
  const update = () => {
    toggle.setAttribute('aria-pressed', String(isUp()));
    app.texts.bind(toggle, isUp() ? 'web.class.hand_down' : 'web.class.hand_up');
  };
  app.on('class', update);
  update();
  return toggle;
}
