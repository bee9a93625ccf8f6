/**
 * "All look here": while it is on, the class gets the instructor's camera and look whenever they change. An end that
 * came while the link was broken is told when it is there again: the server keeps the look.
 */

import type { App } from '../app/state';
import { Throttle } from '../app/throttle';
import { packLook } from './shared_look';

const PAUSE_MS = 100; // the server takes ten a second
const MOST_SHIFT_M = 2e-4; // of the camera, that nobody would see

export class Lead {
  private timer: ReturnType<typeof setInterval> | null = null;
  private sent = '';
  private owesEnd = false;
  private readonly throttle = new Throttle<object>(PAUSE_MS, (look) => this.app.send({ do: 'class_look', look }));

  constructor(private readonly app: App) {
    app.on('connection', () => this.connected());
  }

  get leading(): boolean {
    return this.timer !== null;
  }

  start(): void {
    if (this.leading) return;
    this.sent = '';
    this.owesEnd = false;
    this.timer = setInterval(() => this.look(), PAUSE_MS);
    this.look();
  }

  /** Also of a look that this page did not begin, as one from before it was loaded again. */
  stop(): void {
    if (this.timer !== null) clearInterval(this.timer);
    this.timer = null;
    this.throttle.stop();
    this.end();
  }

  private end(): void {
    this.owesEnd = this.app.connection.state !== 'joined';
    if (!this.owesEnd) this.app.send({ do: 'class_look', look: null });
  }

  private connected(): void {
    this.sent = ''; // a new connection may not know it
    if (this.owesEnd) this.end();
  }

  private look(): void {
    const { app } = this;
    const pose = app.camera.pose();
    const coarse = (place: number[]) => place.map((x) => Math.round(x / MOST_SHIFT_M));
    const now = JSON.stringify([coarse(pose.eye), coarse(pose.target), app.look, app.selection]);
    if (now === this.sent || app.connection.state !== 'joined') return;
    this.sent = now;
    this.throttle.push(packLook(pose, app.look, app.selection));
  }
}
