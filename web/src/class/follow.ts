/** The other end of "all look here": the page looks where the instructor does, until the person looks freely. */

import { button, el } from '../app/dom';
import type { Look } from '../app/look';
import type { App } from '../app/state';
import { unpackLook, type SharedLook } from './shared_look';

const EASE_S = 0.4;

export class Follow {
  private readonly sentence = el('span');
  private readonly toggle = button('plain', () => this.change(!this.following));
  private readonly banner = el('div', { class: 'banner', role: 'status' }, this.sentence, this.toggle);
  private shared: SharedLook | null = null;
  private newest = ''; // what was sent last, to tell what is new
  private following = true;
  private before: Look | null = null; // the person's own, while another one is on
  private hide: (() => void) | null = null;

  constructor(private readonly app: App) {
    app.on('class', ({ look }) => this.take(look));
    if (app.classState) this.take(app.classState.look);
  }

  private take(look: unknown): void {
    const sent = JSON.stringify(look ?? null);
    if (sent === this.newest) return;
    this.newest = sent;
    const began = this.shared === null;
    this.shared = unpackLook(look);
    if (!this.shared) this.end();
    else if (began) this.change(true);
    else if (this.following) this.apply(this.shared);
  }

  private change(following: boolean): void {
    const { app, shared } = this;
    if (!shared) return;
    this.following = following;
    if (following) this.apply(shared);
    else this.restore();
    app.texts.bind(this.sentence, following ? 'web.follow.on' : 'web.follow.off');
    app.texts.bind(this.toggle, following ? 'web.follow.leave' : 'web.follow.return');
    this.hide ??= app.mountOver(this.banner);
  }

  private apply({ camera, view, selected }: SharedLook): void {
    const { app } = this;
    this.before ??= { ...app.look };
    app.camera.moveTo(camera, EASE_S);
    app.setLook(view);
    if (selected !== app.selection) app.select(selected !== null && app.part(selected) ? selected : null);
  }

  private end(): void {
    this.hide?.();
    this.hide = null;
    this.restore();
  }

  private restore(): void {
    if (this.before) this.app.setLook(this.before);
    this.before = null;
  }
}
