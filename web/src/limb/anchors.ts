/**
 * Where labels point to: on every part that is seen, a vertex in the middle of what is seen of it. A small picture in
 * which each part has a colour of its own tells what is seen.
 */
import {
  Mesh,
  Scene,
  ShaderMaterial,
  Vector3,
  WebGLRenderTarget,
  type PerspectiveCamera,
  type WebGLRenderer,
} from 'three';
import type { LimbDrawing } from './drawing';
import type { LimbModel } from './model';
import type { Surface } from './surface';
import { placed, pointAt, turned, type Point } from './vectors';

export interface Anchor {
  surface: Surface;
  vertex: number;
}

const WIDTH = 192;
/** Smaller specks get no label [pixels of the small picture]. */
const LEAST_SEEN = 5;

const vertexShader = 'void main() { gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0); }';
const fragmentShader = 'uniform float number; void main() { gl_FragColor = vec4(number / 255.0, 0.0, 0.0, 1.0); }';

export class Anchors {
  private readonly scene = new Scene();
  private readonly meshes: (Mesh | undefined)[] = [];
  private target = new WebGLRenderTarget(WIDTH, WIDTH);
  private pixels = new Uint8Array(0);

  constructor(
    private readonly model: LimbModel,
    private readonly drawing: LimbDrawing,
  ) {
    this.scene.matrixWorldAutoUpdate = false;
  }

  find(renderer: WebGLRenderer, camera: PerspectiveCamera, seen: (surface: Surface) => boolean): Anchor[] {
    const height = Math.max(1, Math.round(WIDTH / camera.aspect));
    if (this.target.height !== height) this.resize(height);
    for (const surface of this.model.surfaces) if (surface !== undefined) this.prepare(surface, seen(surface));
    renderer.setRenderTarget(this.target);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.readRenderTargetPixels(this.target, 0, 0, WIDTH, height, this.pixels);
    renderer.setRenderTarget(null);
    return this.anchorsIn(height, camera);
  }

  private resize(height: number): void {
    this.target.dispose();
    this.target = new WebGLRenderTarget(WIDTH, height);
    this.pixels = new Uint8Array(4 * WIDTH * height);
  }

  private prepare(surface: Surface, visible: boolean): void {
    const { surface: index } = surface.part;
    const drawn = this.drawing.meshes[index];
    let mesh = this.meshes[index];
    if (drawn === undefined) return;
    if (mesh?.geometry !== drawn.geometry) {
      if (mesh !== undefined) this.scene.remove(mesh);
      const uniforms = { number: { value: index + 1 } };
      mesh = new Mesh(drawn.geometry, new ShaderMaterial({ vertexShader, fragmentShader, uniforms }));
      mesh.frustumCulled = mesh.matrixAutoUpdate = mesh.matrixWorldAutoUpdate = false;
      this.meshes[index] = mesh;
      this.scene.add(mesh);
    }
    mesh.matrixWorld.copy(drawn.matrixWorld);
    mesh.visible = visible && surface.known;
  }

  private anchorsIn(height: number, camera: PerspectiveCamera): Anchor[] {
    const sums = new Map<number, { count: number; x: number; y: number }>();
    this.eachPixel(height, (number, x, y) => {
      const sum = sums.get(number) ?? { count: 0, x: 0, y: 0 };
      sums.set(number, { count: sum.count + 1, x: sum.x + x, y: sum.y + y });
    });
    const middles = new Map<number, { x: number; y: number; away: number }>();
    this.eachPixel(height, (number, x, y) => {
      const { count, x: sumX, y: sumY } = sums.get(number)!;
      const away = Math.hypot(x - sumX / count, y - sumY / count);
      if (count >= LEAST_SEEN && away < (middles.get(number)?.away ?? Infinity)) middles.set(number, { x, y, away });
    });
    return [...middles].flatMap(([number, { x, y }]) => {
      const surface = this.model.surfaces[number - 1];
      if (surface === undefined) return [];
      const place: [number, number] = [(2 * (x + 0.5)) / WIDTH - 1, (2 * (y + 0.5)) / height - 1];
      return [{ surface, vertex: vertexAt(this.model, surface, camera, place) }];
    });
  }

  private eachPixel(height: number, use: (number: number, x: number, y: number) => void): void {
    for (let y = 0, at = 0; y < height; ++y) {
      for (let x = 0; x < WIDTH; ++x, at += 4) if (this.pixels[at] !== 0) use(this.pixels[at]!, x, y);
    }
  }
}

/** The vertex on the near side that is seen nearest to a place of the picture, -1 to 1. */
function vertexAt(model: LimbModel, surface: Surface, camera: PerspectiveCamera, [x, y]: [number, number]): number {
  const eye = camera.position;
  let best = 0;
  let best_away = Infinity;
  for (let vertex = 0; vertex < surface.drawn_m.length / 3; ++vertex) {
    const { place, normal } = vertexOf(model, surface, vertex);
    if ((eye.x - place[0]) * normal[0] + (eye.y - place[1]) * normal[1] + (eye.z - place[2]) * normal[2] <= 0) continue;
    const seen = new Vector3(...place).project(camera);
    const away = Math.hypot((seen.x - x) * camera.aspect, seen.y - y);
    if (away < best_away) [best, best_away] = [vertex, away];
  }
  return best;
}

/** Of a drawn vertex, in the world. */
export function vertexOf(model: LimbModel, surface: Surface, vertex: number): { place: Point; normal: Point } {
  const place = pointAt(surface.drawn_m, vertex);
  const normal = pointAt(surface.normals, vertex);
  if (surface.body < 0) return { place, normal };
  const pose = model.drawnPose(surface.body);
  return { place: placed(pose, place), normal: turned(pose, normal) };
}
