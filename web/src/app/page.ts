/** The one `App` of a page: keeps the newest of everything and tells whoever listens. */
import { readClassState } from '../class/class_state';
import type { LimbView } from '../limb/view';
import type { InForce, Picture, Readings } from '../wire/moment';
import { Emitter } from './emitter';
import { partsOf, type Part, type SceneFacts } from './facts';
import type { Layout } from './layout';
import { plainLook, type Camera, type Look } from './look';
import type {
  App,
  AppEvents,
  ClassState,
  Connection,
  FrameTap,
  Me,
  Mode,
  PanelOptions,
  PanelSide,
  Texts,
  Touch,
} from './state';

/** What a page is made of. */
export interface PageParts {
  texts: Texts;
  scene: SceneFacts;
  lessons: readonly unknown[];
  layout: Layout;
}

/** Where what the page sends goes, and what it keeps for a recording. */
export interface Line {
  send(control: object): void;
  primingFrames(): Uint8Array[];
  wholePicture(): Uint8Array | null;
}

const noTouch: Touch = { part: null, force_N: 0, depth_m: 0, line: null, fraction: 0, tension_N: 0 };

export class Page implements App {
  readonly texts: Texts;
  readonly scene: SceneFacts;
  readonly lessons: readonly unknown[];
  readonly parts: readonly Part[];
  me: Me = { client: 0, name: '', role: 'viewer', hand: -1 };
  connection: Connection = { state: 'joining' };
  readings: Readings | null = null;
  inForce: InForce | null = null;
  classState: ClassState | null = null;
  touch: Touch = noTouch;
  look: Look = plainLook();
  selection: string | null = null;
  mode: Mode = 'look';
  line: Line | null = null;
  view: LimbView | null = null;
  private readonly byKey: Map<string, Part>;
  private readonly emitter = new Emitter<AppEvents>();
  private readonly taps = new Set<FrameTap>();
  private readonly layout: Layout;

  constructor({ texts, scene, lessons, layout }: PageParts) {
    this.texts = texts;
    this.scene = scene;
    this.lessons = lessons;
    this.layout = layout;
    this.parts = partsOf(scene);
    this.byKey = new Map(this.parts.map((part) => [part.key, part]));
    texts.onChange((language) => this.emitter.emit('language', language));
  }

  get camera(): Camera {
    if (this.view === null) throw new Error('the limb is not drawn yet');
    return this.view.camera;
  }

  part(key: string): Part | undefined {
    return this.byKey.get(key);
  }

  bodyOfBone(index: number): number {
    const bone = this.view?.model.surfaces[this.scene.muscles.length + index];
    return bone?.body ?? -1;
  }

  nameOf(key: string): string {
    const part = this.part(key);
    if (part === undefined) return key;
    return (this.look.names === 'latin' ? part.latin : part.english) || part.english || part.latin || key;
  }

  setLook(change: Partial<Look>): void {
    this.look = { ...this.look, ...change };
    this.emitter.emit('look', this.look);
  }

  select(key: string | null): void {
    if (key === this.selection) return;
    this.selection = key;
    this.emitter.emit('selection', key);
  }

  setMode(mode: Mode): void {
    if (mode === this.mode) return;
    this.mode = mode;
    this.emitter.emit('mode', mode);
  }

  send(control: object): void {
    this.line?.send(control);
  }

  on<K extends keyof AppEvents>(event: K, listener: (value: AppEvents[K]) => void): () => void {
    return this.emitter.on(event, listener);
  }

  emit<K extends keyof AppEvents>(event: K, value: AppEvents[K]): void {
    this.emitter.emit(event, value);
  }

  mountPanel(side: PanelSide, id: string, titleKey: string, element: HTMLElement, options?: PanelOptions): () => void {
    return this.layout.addPanel(side, id, titleKey, element, options);
  }

  reveal(id: string): void {
    this.layout.reveal(id);
  }

  mountTool(element: HTMLElement): void {
    this.layout.tools.append(element);
  }

  mountOver(element: HTMLElement): () => void {
    this.layout.over.append(element);
    return () => element.remove();
  }

  toast(text: string): void {
    this.layout.toast(text);
  }

  tapFrames(tap: FrameTap): () => void {
    this.taps.add(tap);
    return () => this.taps.delete(tap);
  }

  primingFrames(): Uint8Array[] {
    return this.line?.primingFrames() ?? [];
  }

  wholePicture(): Uint8Array | null {
    return this.line?.wholePicture() ?? null;
  }

  tapped(raw: Uint8Array): void {
    for (const tap of this.taps) tap(raw, performance.now());
  }

  setMe(me: Me): void {
    this.me = me;
    this.emitter.emit('me', me);
  }

  setConnection(connection: Connection): void {
    this.connection = connection;
    this.emitter.emit('connection', connection);
  }

  setTouch(touch: Touch | null): void {
    this.touch = touch ?? noTouch;
    this.emitter.emit('touch', this.touch);
  }

  takePicture(picture: Picture): void {
    if (picture.readings !== null) this.readings = picture.readings;
    if (picture.inForce !== null) this.inForce = picture.inForce;
    this.emitter.emit('picture', picture);
    if (picture.readings !== null) this.emitter.emit('readings', picture.readings);
    if (picture.inForce !== null) this.emitter.emit('inForce', picture.inForce);
  }

  takeControl(message: Record<string, unknown>): void {
    const { class: ours } = message;
    if (typeof ours === 'object' && ours !== null) {
      this.classState = readClassState(ours, this.me.client, this.classState);
      this.emitter.emit('class', this.classState);
    }
    this.emitter.emit('control', message);
  }
}
