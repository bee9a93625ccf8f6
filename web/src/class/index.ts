/** What a class has in common: one look, one question, hands, and the instructor's controls. */

import type { App } from '../app/state';
import { BenchPanel } from './bench_panel';
import { ClassPanel } from './class_panel';
import { Follow } from './follow';
import { handUpButton } from './hand_up';
import { joinButton } from './join_dialog';
import { QuestionView } from './question_view';
import { ResultsPanel } from './results_panel';

export function mountClass(app: App): void {
  if (app.me.role === 'instructor') {
    if (app.scene.co_contraction) {
      app.mountPanel('right', 'bench', 'demonstrate.presets', new BenchPanel(app).element, { order: 6 });
    }
    app.mountPanel('right', 'class', 'web.class.title', new ClassPanel(app).element, { order: 5 });
    app.mountPanel('right', 'results', 'web.results.title', new ResultsPanel(app).element, { order: 50, folded: true });
    app.mountTool(joinButton(app));
    return;
  }
  new Follow(app);
  if (app.me.role !== 'student') return;
  new QuestionView(app);
  app.mountTool(handUpButton(app));
}
