/**
 * The page's hand: what it does, what it sends 60 times a second while it does something and 20 times otherwise, and
 * what it feels.
 *
 *   rest --press on the limb--> Press --let go, frozen--> rest
 *        --press near a line--> Pull  --let go, frozen--> rest
 */
import type { Page } from '../app/page';
import type { Hit, Ray } from '../limb/picking';
import { add, length, scale, type Point } from '../limb/vectors';
import type { LimbView } from '../limb/view';
import type { Surface } from '../limb/surface';
import type { Force } from '../wire/small';
import type { ToolState } from '../wire/tool_state';
import { Press, RADIUS_M, type Felt } from './press';
import { LINE_STIFFNESS_N_M, nearestOnLine, pointOnLine, Pull } from './pull';

const BUSY_EVERY_MS = 1000 / 60;
const REST_EVERY_MS = 50;
const GRAB_LINE = 1;
/** Of the low pass over the felt force: what a number on a screen can follow. */
const SMOOTH_S = 0.08;
/** How far above the limb a tool hovers that touches nothing. */
const HOVER_M = 0.002;

export type SendState = (state: ToolState) => void;

export class Hand {
  private press: Press | null = null;
  private pull: Pull | null = null;
  private hover_m: Point | null = null;
  private sequence = 0;
  private sent_ms = 0;
  private force_N = 0;
  private forced_ms = 0;
  private touched: string | null = null;
  /** Depth that is wanted, by wheel, slider or a pen's pressure. */
  wanted_m = 0.006;

  constructor(
    private readonly page: Page,
    private readonly view: LimbView,
    private readonly sendState: SendState,
  ) {
    page.on('class', () => this.frozen && this.letGo());
    page.on('connection', () => this.letGo());
    setInterval(() => this.tick(), BUSY_EVERY_MS);
  }

  get busy(): boolean {
    return this.press !== null || this.pull !== null;
  }

  private get frozen(): boolean {
    return this.page.classState?.frozen === true && this.page.me.role !== 'instructor';
  }

  /** Whether this hand may do something now. */
  get able(): boolean {
    return this.page.me.hand >= 0 && this.page.connection.state === 'joined' && !this.frozen;
  }

  beginPress(hit: Hit, wanted: (surface: Surface) => boolean): void {
    this.press = new Press(this.view.model, hit, wanted);
    this.forced_ms = 0;
    this.force_N = 0;
  }

  /** Takes the line of the muscle that was hit; false: it has none. */
  beginPull(hit: Hit, towardsEye: Point): boolean {
    const { part } = hit.surface;
    if (part.kind !== 'muscle') return false;
    const found = nearestOnLine(this.page.readings?.lines_m[part.index] ?? [], hit.point_m);
    if (found === null) return false;
    this.pull = new Pull(part.index, found.fraction, found.point_m, towardsEye);
    this.force_N = 0;
    return true;
  }

  moveTo(ray: Ray): void {
    this.press?.strokeTo(ray);
    this.pull?.dragTo(ray);
  }

  hoverAt(hit: Hit | null): void {
    this.hover_m = hit && add(hit.point_m, scale(hit.normal, RADIUS_M + HOVER_M));
    if (!this.busy) this.view.tools.setOwn(this.hover_m && ownAt(this.hover_m, this.hover_m));
    this.view.repaint();
  }

  letGo(): void {
    if (!this.busy) return;
    this.press = this.pull = null;
    this.touched = null;
    this.force_N = 0;
    this.sent_ms = 0;
    this.view.tools.setOwn(null);
    this.page.setTouch(null);
  }

  takeForce({ tool_sequence, force_N }: Force): void {
    if (!this.busy || tool_sequence === 0) return;
    const now_ms = performance.now();
    const share = 1 - Math.exp(-(now_ms - (this.forced_ms || now_ms)) / 1000 / SMOOTH_S);
    this.force_N += share * (length(force_N) - this.force_N);
    this.forced_ms = now_ms;
  }

  private tick(): void {
    const now_ms = performance.now();
    const since_ms = now_ms - this.sent_ms;
    if (!this.able || since_ms < 0.9 * (this.busy ? BUSY_EVERY_MS : REST_EVERY_MS)) return;
    this.sent_ms = now_ms;
    if (this.press !== null) this.tickPress(this.press, Math.min(since_ms / 1000, 0.05));
    else if (this.pull !== null) this.tickPull(this.pull);
    else this.sendState(this.state(this.hover_m ?? this.away()));
  }

  private tickPress(press: Press, seconds: number): void {
    press.advance(this.wanted_m, seconds);
    const felt = press.feel();
    const { tool_m, proxy_m, force_N, contact } = felt;
    this.sendState({ ...this.state(tool_m), proxy_m, force_N, contact });
    this.touched = felt.surface?.part.key ?? null;
    this.view.tools.setOwn({ proxy_m, hand_m: tool_m, radius_m: RADIUS_M });
    this.report(felt, press.depth);
  }

  private report(felt: Felt, depth_m: number): void {
    const force_N = felt.contact === null ? 0 : this.force_N;
    this.page.setTouch({ part: this.touched, force_N, depth_m, line: null, fraction: 0, tension_N: 0 });
  }

  private tickPull(pull: Pull): void {
    const { readings, parts } = this.page;
    const held_m = pointOnLine(readings?.lines_m[pull.muscle] ?? [], pull.fraction);
    const force_N = scale(
      [held_m[0] - pull.hand[0], held_m[1] - pull.hand[1], held_m[2] - pull.hand[2]],
      LINE_STIFFNESS_N_M,
    );
    this.sendState({ ...this.state(pull.hand), proxy_m: held_m, force_N, grip: pull.grip(), buttons: GRAB_LINE });
    this.view.tools.setOwn({ proxy_m: held_m, hand_m: pull.hand, radius_m: RADIUS_M });
    this.page.setTouch({
      part: null,
      force_N: this.force_N,
      depth_m: 0,
      line: parts[pull.muscle]?.key ?? null,
      fraction: pull.fraction,
      tension_N: readings?.tensions_N[pull.muscle] ?? 0,
    });
  }

  /** Of a hand that touches nothing. */
  private state(tool_m: Point): ToolState {
    const free = { force_N: [0, 0, 0] as Point, buttons: 0, faults: 0, contact: null, grip: null };
    return { tool_m, proxy_m: tool_m, sequence: ++this.sequence, model_sequence: 0, ...free };
  }

  /** A place where it is in nobody's way: beside the eye. */
  private away(): Point {
    return this.view.camera.pose().eye;
  }
}

function ownAt(proxy_m: Point, hand_m: Point): { proxy_m: Point; hand_m: Point; radius_m: number } {
  return { proxy_m, hand_m, radius_m: RADIUS_M };
}
