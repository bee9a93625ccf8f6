/** Draws the limb, only when something changed, and says what lies under a pointer. */
import { Color, Object3D, Raycaster, Scene, Vector2, Vector3, WebGLRenderer } from 'three';
import { el } from '../app/dom';
import type { App } from '../app/state';
import type { Mesh } from '../wire/mesh';
import type { Picture, ToolReading } from '../wire/moment';
import { Anchors, vertexOf } from './anchors';
import { LimbCamera } from './camera';
import { LimbDrawing } from './drawing';
import { Fineness } from './fineness';
import { Labels } from './labels';
import { LinesDrawing } from './lines_drawing';
import { LimbModel } from './model';
import { raycast, type Hit, type Ray } from './picking';
import type { Surface } from './surface';
import { isAtWork, ToolsDrawing } from './tools_drawing';
import { isSolid } from './visibility';

const ANCHORS_EVERY_MS = 250;
const ACCENT: [number, number, number] = [0.05, 0.62, 0.74];

export class LimbView {
  readonly element = el('div', { class: 'limb' });
  readonly canvas = el('canvas', { class: 'limb-canvas', tabindex: '0' });
  readonly model: LimbModel;
  readonly camera: LimbCamera;
  readonly tools = new ToolsDrawing();
  private readonly fineness = new Fineness();
  private readonly renderer: WebGLRenderer;
  private readonly scene = new Scene();
  private readonly drawing: LimbDrawing;
  private readonly lines = new LinesDrawing();
  private readonly labels: Labels;
  private readonly anchors: Anchors;
  private app: App | null = null;
  private hovered: string | null = null;
  private stale = true;
  private lookStale = true;
  private anchorsStale = true;
  private anchorsDue_ms = 0;
  private othersSeen = false;
  private last_ms = performance.now();
  private readonly caster = new Raycaster();

  constructor(parts: App['parts']) {
    const { slow } = this.fineness;
    this.renderer = new WebGLRenderer({ canvas: this.canvas, antialias: !slow, alpha: !slow });
    if (slow) this.fillBackground();
    this.model = new LimbModel(parts);
    this.drawing = new LimbDrawing(this.model);
    this.anchors = new Anchors(this.model, this.drawing);
    this.labels = new Labels(this.model);
    this.camera = new LimbCamera(this.canvas, this.model, matchMedia('(prefers-reduced-motion: reduce)').matches);
    this.element.append(this.canvas, this.labels.element);
    const limb = new Object3D().add(this.drawing.group, this.lines.group, this.tools.group);
    this.scene.add(limb);
    new ResizeObserver(() => this.resize()).observe(this.element);
  }

  /** A canvas that is seen through costs a software renderer a third of its frame: it gets the paper's colour. */
  private fillBackground(): void {
    const dark = matchMedia('(prefers-color-scheme: dark)');
    const fill = (): void => {
      const paper = getComputedStyle(document.documentElement).getPropertyValue('--paper').trim();
      this.scene.background = new Color(paper);
      this.repaint();
    };
    dark.addEventListener('change', fill);
    fill();
  }

  start(app: App): void {
    this.app = app;
    for (const event of ['look', 'language'] as const) app.on(event, () => this.changed());
    for (const event of ['selection', 'touch'] as const) app.on(event, () => this.repaint());
    app.on('readings', () => this.followReadings(app));
    requestAnimationFrame((now_ms) => this.frame(now_ms));
  }

  takeMesh(mesh: Mesh): void {
    const surface = this.model.takeMesh(mesh);
    if (surface !== undefined) this.drawing.add(surface, null);
    this.changed();
  }

  takePicture(picture: Picture): void {
    this.model.takePicture(picture, performance.now());
    this.camera.begin();
  }

  /** The sky's share of each vertex, skins before bones, as `/shade.bin` has it; after all meshes came. */
  takeShade(shade: Uint8Array): void {
    let at = 0;
    for (const surface of this.model.surfaces) {
      if (surface === undefined) return;
      const count = surface.rest_m.length / 3;
      if (at + count > shade.length) return;
      this.drawing.setShade(surface, shade.slice(at, at + count));
      at += count;
    }
    this.changed();
  }

  /** Draws anew at the next frame. */
  repaint(): void {
    this.lookStale = this.stale = true;
  }

  /** The same where other parts may be seen now. */
  private changed(): void {
    this.repaint();
    this.anchorsStale = true;
  }

  /** They come five times a second; a limb at rest in its own colours is not drawn again for them. */
  private followReadings(app: App): void {
    const { colour, lines } = app.look;
    const others = this.othersOf(app).length > 0;
    const tells = colour === 'activation' || colour === 'tension' || lines || app.touch.line !== null;
    if (tells || others || this.othersSeen) this.repaint();
    this.othersSeen = others;
  }

  private othersOf({ me, readings }: App): ToolReading[] {
    return (readings?.tools ?? []).filter((tool, hand) => hand !== me.hand && isAtWork(tool));
  }

  setHovered(key: string | null): void {
    if (key === this.hovered) return;
    this.hovered = key;
    this.repaint();
  }

  /** Through a place of the page [px]. */
  rayAt(clientX: number, clientY: number): Ray {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const place = new Vector2((2 * (clientX - left)) / width - 1, 1 - (2 * (clientY - top)) / height);
    this.caster.setFromCamera(place, this.camera.three);
    const { origin, direction } = this.caster.ray;
    return { origin_m: origin.toArray(), direction: direction.toArray() };
  }

  /** Where on the page the middle of what is seen of a part is; null: nothing is seen of it. */
  placeOf(key: string): { clientX: number; clientY: number } | null {
    const seen = this.anchors.find(
      this.renderer,
      this.camera.three,
      ({ part }) => this.app !== null && isSolid(part, this.app.look),
    );
    const anchor = seen.find(({ surface }) => surface.part.key === key);
    if (anchor === undefined) return null;
    const place = new Vector3(...vertexOf(this.model, anchor.surface, anchor.vertex).place).project(this.camera.three);
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    return { clientX: left + ((place.x + 1) / 2) * width, clientY: top + ((1 - place.y) / 2) * height };
  }

  /** The nearest of the wanted parts there. */
  hitAt(clientX: number, clientY: number, wanted: (surface: Surface) => boolean): Hit | null {
    return raycast(this.model, this.rayAt(clientX, clientY), wanted);
  }

  private resize(): void {
    const { clientWidth: width, clientHeight: height } = this.element;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.fineness.ratio);
    this.renderer.setSize(width, height, false);
    this.camera.resize(width, height);
    this.changed();
  }

  private frame(now_ms: number): void {
    requestAnimationFrame((next_ms) => this.frame(next_ms));
    const app = this.app;
    if (app === null) return;
    const turned = this.camera.controls.update((now_ms - this.last_ms) / 1000);
    this.last_ms = now_ms;
    const { moved, posed } = this.model.advance(performance.now());
    this.drawing.follow(moved, posed, app.readings);
    this.anchorsStale ||= turned;
    const labelled = app.look.labels && app.look.names !== 'none';
    const anchorsDue = labelled && this.anchorsStale && now_ms >= this.anchorsDue_ms;
    const moving = turned || posed || moved.length > 0;
    const finer = this.fineness.follow(moving, now_ms);
    if (!moving && !this.stale && !finer && !anchorsDue) return;
    if (finer) this.renderer.setPixelRatio(this.fineness.ratio);
    if (this.lookStale) this.applyLook(app);
    this.stale = this.lookStale = false;
    this.renderer.render(this.scene, this.camera.three);
    this.labels.element.hidden = !labelled;
    if (anchorsDue) this.findAnchors(app, now_ms);
    if (labelled) this.labels.follow(this.camera.three, this.element.clientWidth, this.element.clientHeight);
  }

  private applyLook(app: App): void {
    const marks = { selected: app.selection, hovered: this.hovered };
    this.drawing.applyLook(app.look, marks, app.readings, ACCENT);
    const inHand = app.touch.line === null ? undefined : app.part(app.touch.line);
    this.lines.show(app.readings, (muscle) => app.look.lines || muscle === inHand?.index);
    this.tools.setOthers(this.othersOf(app));
  }

  private findAnchors(app: App, now_ms: number): void {
    this.anchorsStale = false;
    this.anchorsDue_ms = now_ms + (this.fineness.slow ? 4 : 1) * ANCHORS_EVERY_MS;
    const anchors = this.anchors.find(this.renderer, this.camera.three, (surface) => isSolid(surface.part, app.look));
    this.labels.show(anchors, (key) => app.nameOf(key));
  }
}
