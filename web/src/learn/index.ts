/** Puts the lessons into the page: the panel, and the lesson that an instructor opens for all. */

import type { App } from '../app/state';
import { LearnPanel } from './learn_panel';

export function mountLearn(app: App): void {
  if (app.connection.state === 'playing') return; // a lesson wants a hand
  const panel = new LearnPanel(app);
  // Near the force for those who learn; below the class's controls for those who teach.
  const order = app.me.role === 'instructor' ? 40 : 15;
  app.mountPanel('right', 'learn', 'tasks.learn', panel.element, { order });
  let given: string | null = null; // by the instructor
  app.on('class', ({ lesson }) => {
    if (lesson === given || app.me.role === 'instructor') return;
    given = lesson;
    if (lesson === null) return; // who is in the middle of it may finish
    app.toast(app.texts.t(panel.open(lesson) ? 'web.learn.given' : 'web.learn.given_unknown'));
  });
}
