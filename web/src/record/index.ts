/** Recording a class's limb, for instructors; a page that plays a recording has its time bar instead. */

import type { App } from '../app/state';
import { RecordPanel } from './record_panel';

export function mountRecord(app: App): void {
  if (app.me.role !== 'instructor') return;
  app.mountPanel('right', 'record', 'web.record.title', new RecordPanel(app).element, { order: 60, folded: true });
}
