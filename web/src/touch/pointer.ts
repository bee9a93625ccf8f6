/** Mouse, pen and finger over the limb: they select, touch and pull, and else turn the camera. */
import type { Page } from '../app/page';
import type { Surface } from '../limb/surface';
import { subtract, unit, type Point } from '../limb/vectors';
import type { LimbView } from '../limb/view';
import { isSolid } from '../limb/visibility';
import type { Hand } from './hand';

/** A press that moves no farther is a click [px]. */
const CLICK_PX = 6;
/** At full pressure of a pen. */
const PEN_DEPTH_M = 0.012;
export const DEPTHS_M = { least: 0.001, most: 0.015, step: 0.001 };

export class Pointer {
  private down: { id: number; x: number; y: number } | null = null;
  private working: number | null = null;

  constructor(
    private readonly page: Page,
    private readonly view: LimbView,
    private readonly hand: Hand,
    private readonly onDepth: () => void,
  ) {
    const { element, canvas } = view;
    // Before the camera's own listeners, which are on the canvas: a press on the limb is not a turn of it.
    element.addEventListener('pointerdown', (event) => this.press(event), { capture: true });
    element.addEventListener('pointermove', (event) => this.move(event), { capture: true });
    for (const end of ['pointerup', 'pointercancel', 'lostpointercapture'] as const) {
      element.addEventListener(end, (event) => this.release(event), { capture: true });
    }
    element.addEventListener('wheel', (event) => this.wheel(event), { capture: true, passive: false });
    canvas.addEventListener('pointerleave', () => this.leave());
    document.addEventListener('visibilitychange', () => document.hidden && this.stop());
  }

  private press(event: PointerEvent): void {
    if (event.target !== this.view.canvas || event.button !== 0) return;
    this.down = { id: event.pointerId, x: event.clientX, y: event.clientY };
    if (this.working !== null) return event.stopPropagation();
    if (this.page.mode === 'look' || !this.begin(event)) return;
    this.working = event.pointerId;
    this.view.canvas.setPointerCapture(event.pointerId);
    this.view.camera.controls.enabled = false;
    event.preventDefault();
    event.stopPropagation();
  }

  private begin(event: PointerEvent): boolean {
    if (!this.hand.able) return false;
    const wanted = this.reached;
    const hit = this.view.hitAt(event.clientX, event.clientY, wanted);
    if (hit === null) return false;
    this.penDepth(event);
    this.view.setHovered(null);
    if (this.page.mode === 'pull') return this.hand.beginPull(hit, towardsEye(this.view));
    this.hand.beginPress(hit, wanted);
    return true;
  }

  private readonly seen = ({ part }: Surface): boolean => isSolid(part, this.page.look);

  /** What is drawn; while a quiz hides all names, what it hides too: to be known by touch alone. */
  private readonly reached = ({ part }: Surface): boolean => {
    const { look } = this.page;
    return isSolid(part, look) || (look.names === 'none' && look.only !== null);
  };

  private move(event: PointerEvent): void {
    if (event.pointerId === this.working) {
      this.penDepth(event);
      this.hand.moveTo(this.view.rayAt(event.clientX, event.clientY));
      event.stopPropagation();
    } else if (event.buttons === 0 && event.target === this.view.canvas) {
      this.hover(event);
    }
  }

  private hover({ clientX, clientY }: PointerEvent): void {
    const hit = this.view.hitAt(clientX, clientY, this.page.mode === 'look' ? this.seen : this.reached);
    this.view.setHovered(hit?.surface.part.key ?? null);
    this.view.canvas.dataset['over'] = hit === null ? 'nothing' : this.page.mode;
    if (this.page.mode === 'touch' && this.hand.able) this.hand.hoverAt(hit);
  }

  private release(event: PointerEvent): void {
    if (event.pointerId === this.working) {
      this.stop();
      event.stopPropagation();
    } else if (event.type === 'pointerup' && this.isClick(event) && this.page.mode === 'look') {
      this.pick(event);
    }
    if (event.pointerId === this.down?.id) this.down = null;
  }

  private isClick({ pointerId, clientX, clientY }: PointerEvent): boolean {
    const { down } = this;
    return down?.id === pointerId && Math.hypot(clientX - down.x, clientY - down.y) <= CLICK_PX;
  }

  private pick({ clientX, clientY }: PointerEvent): void {
    const hit = this.view.hitAt(clientX, clientY, this.seen);
    const key = hit?.surface.part.key ?? null;
    this.page.select(key);
    this.page.emit('picked', { key, point_m: hit?.point_m ?? null });
  }

  /** While it touches, the wheel sets how deep; else it is the camera's. */
  private wheel(event: WheelEvent): void {
    if (!this.hand.busy) return;
    event.preventDefault();
    event.stopPropagation();
    const wanted_m = this.hand.wanted_m - Math.sign(event.deltaY) * DEPTHS_M.step;
    this.hand.wanted_m = Math.min(DEPTHS_M.most, Math.max(DEPTHS_M.least, wanted_m));
    this.onDepth();
  }

  private penDepth(event: PointerEvent): void {
    if (event.pointerType !== 'pen' || event.pressure === 0) return;
    this.hand.wanted_m = Math.max(DEPTHS_M.least, event.pressure * PEN_DEPTH_M);
    this.onDepth();
  }

  private leave(): void {
    this.view.setHovered(null);
    if (!this.hand.busy) this.hand.hoverAt(null);
  }

  private stop(): void {
    if (this.working === null) return;
    this.working = null;
    this.hand.letGo();
    this.view.camera.controls.enabled = true;
  }
}

/** From what is looked at, of unit length. */
export function towardsEye(view: LimbView): Point {
  const { eye, target } = view.camera.pose();
  return unit(subtract(eye, target));
}
