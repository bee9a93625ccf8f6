/**
 * The hand by keyboard: with the limb in focus, Space held touches or pulls what is selected, the arrows stroke or drag;
 * without, the arrows turn the limb and plus and minus come nearer and go away.
 */
import type { Page } from '../app/page';
import type { LimbView } from '../limb/view';
import { isSolid } from '../limb/visibility';
import type { Hand } from './hand';
import { towardsEye } from './pointer';

const STROKE_PX = 4;
const TURN_RAD = 0.12;
const NEARER = 0.12;

const arrows: Record<string, [number, number]> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

export class KeyHand {
  private place: { clientX: number; clientY: number } | null = null;

  constructor(
    private readonly page: Page,
    private readonly view: LimbView,
    private readonly hand: Hand,
  ) {
    view.canvas.addEventListener('keydown', (event) => this.down(event));
    view.canvas.addEventListener('keyup', (event) => event.key === ' ' && this.release());
    view.canvas.addEventListener('blur', () => this.release());
  }

  private down(event: KeyboardEvent): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = arrows[event.key];
    const { controls } = this.view.camera;
    if (event.key === ' ') this.press();
    else if (arrow !== undefined) this.move(arrow);
    else if (event.key === '+') void controls.dolly(controls.distance * NEARER, true);
    else if (event.key === '-') void controls.dolly(-controls.distance * NEARER, true);
    else return;
    event.preventDefault();
  }

  private press(): void {
    const { selection, mode, look } = this.page;
    if (this.hand.busy || !this.hand.able || selection === null) return;
    const place = this.view.placeOf(selection);
    const wanted = ({ part }: { part: Parameters<typeof isSolid>[0] }): boolean => isSolid(part, look);
    if (place === null) return;
    // At the edge of what is seen of it, a neighbour may lie a hair's breadth before it.
    const hit =
      this.view.hitAt(place.clientX, place.clientY, ({ part }) => part.key === selection) ??
      this.view.hitAt(place.clientX, place.clientY, wanted);
    if (hit === null) return;
    if (mode === 'touch') this.hand.beginPress(hit, wanted);
    else if (mode !== 'pull' || !this.hand.beginPull(hit, towardsEye(this.view))) return;
    this.place = place;
  }

  private move([right, down]: [number, number]): void {
    if (this.place === null) return void this.view.camera.controls.rotate(-right * TURN_RAD, -down * TURN_RAD, true);
    this.place = { clientX: this.place.clientX + right * STROKE_PX, clientY: this.place.clientY + down * STROKE_PX };
    this.hand.moveTo(this.view.rayAt(this.place.clientX, this.place.clientY));
  }

  private release(): void {
    if (this.place === null) return;
    this.place = null;
    this.hand.letGo();
  }
}
