/** What is felt and how stiff the joint is, now and in the last half minute. */
import type { App } from '../app/state';
import { ForceGauge } from './force_gauge';
import { StiffnessView } from './stiffness_view';

export function mountLive(app: App): void {
  app.mountPanel('right', 'felt', 'web.felt.title', new ForceGauge(app).element, { order: 10 });
  if (app.scene.joints.length > 0) {
    app.mountPanel('right', 'stiffness', 'web.stiffness.title', new StiffnessView(app).element, { order: 20 });
  }
}
