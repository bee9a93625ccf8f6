/** The panels of the page, each from its own folder. */
import { mountClass } from '../class';
import { mountLearn } from '../learn';
import { mountFind } from '../panels/find';
import { mountLive } from '../panels/live';
import { mountRecord } from '../record';
import { languageChoice } from '../text/language_choice';
import type { App } from './state';

export function mountPanels(app: App): void {
  mountFind(app);
  mountLive(app);
  mountClass(app);
  mountLearn(app);
  mountRecord(app);
  app.mountTool(languageChoice(app));
}
