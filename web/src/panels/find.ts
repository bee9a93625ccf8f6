/** The left side: search and list of parts, layers, and the card of the selected part. */

import type { App } from '../app/state';
import { LayerControls } from '../find/layer_controls';
import { PartCard } from '../find/part_card';
import { PartList } from '../find/part_list';

export function mountFind(app: App): void {
  app.mountPanel('left', 'find', 'web.find.title', new PartList(app).element, { order: 10 });
  app.mountPanel('left', 'card', 'web.card.title', new PartCard(app).element, { order: 20 });
  app.mountPanel('left', 'layers', 'see.layers', new LayerControls(app).element, { order: 30 });
}
