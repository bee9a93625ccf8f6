import { button } from '../app/dom';
import type { App } from '../app/state';

/** A student's hand: up until the student takes it down, over breaks, after which the server knows of none. */
export function handUpButton(app: App): HTMLButtonElement {
  let wanted = false;
  let shown: boolean | null = null;
  const isUp = () => app.classState?.you.hand_up === true;
  const toggle = button('toggle', () => {
    wanted = !isUp();
    app.send({ do: 'class_hand_up', on: wanted });
  });
  const update = () => {
    if (isUp() === shown) return;
    shown = isUp();
    toggle.setAttribute('aria-pressed', String(shown));
    app.texts.bind(toggle, shown ? 'web.class.hand_down' : 'web.class.hand_up');
  };
  app.on('connection', ({ state }) => {
    if (state === 'joined' && wanted) app.send({ do: 'class_hand_up', on: true });
  });
  app.on('class', update);
  update();
  return toggle;
}
