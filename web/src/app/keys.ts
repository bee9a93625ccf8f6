/** Keys of the page, those of the window where it has them. */
import type { Hand } from '../touch/hand';
import type { Side } from './look';
import type { Page } from './page';
import type { Mode } from './state';
import { isTyping } from './typing';

const sides: Record<string, Side> = {
  '1': 'lateral',
  '2': 'medial',
  '3': 'cranial',
  '4': 'caudal',
  '5': 'dorsal',
  '6': 'palmar',
};
const modes: Record<string, Mode> = { v: 'look', t: 'touch', p: 'pull' };

export class Keys {
  constructor(
    private readonly page: Page,
    private readonly hand: Hand,
  ) {
    document.addEventListener('keydown', (event) => this.press(event));
  }

  private press(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey || isTyping(event.target)) return;
    const key = event.key.toLowerCase();
    const [side, mode] = [sides[key], modes[key]];
    if (side !== undefined) this.page.camera.showFrom(side);
    else if (mode !== undefined && (mode === 'look' || this.page.me.hand >= 0)) this.page.setMode(mode);
    else if (key === 'l') this.page.setLook({ labels: !this.page.look.labels });
    else if (key === 'f') this.page.camera.frame(this.page.selection);
    else if (key === 'home' && !isSlider(event.target)) this.page.camera.frame(null);
    else if (key === 'escape') this.hand.letGo();
  }
}

/** Home moves a slider to its beginning. */
function isSlider(target: EventTarget | null): boolean {
  return target instanceof HTMLInputElement && target.type === 'range';
}
