/** The limb's surfaces and poses: where the newest picture has them, and where they are drawn on the way there. */
import type { Part } from '../app/facts';
import type { Mesh } from '../wire/mesh';
import type { Picture } from '../wire/moment';
import { Beat, Glide } from './glide';
import { setNormals, setSphere, surfaceOf, type Surface } from './surface';

/** Less is not seen: a tenth of a pixel of a limb that fills a screen. */
const TREMBLE_M = 6e-5;
/** Of the numbers of a pose: metres, and as much at the end of a limb's rotation. */
const POSE_TREMBLE = 2e-5;
const IDENTITY = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);

export class LimbModel {
  /** By number of the surface; those without a mesh are missing. */
  readonly surfaces: (Surface | undefined)[] = [];
  /** Of each body, 3x4 by rows, where the newest picture has it. */
  newestPoses: Float32Array[] = [];
  private poseGlides: Glide[] = [];
  private skinGlides = new Map<number, Glide>();
  private readonly beat = new Beat();

  constructor(private readonly parts: readonly Part[]) {}

  /** Undefined where nothing is new: a page that comes back is sent all of them again. */
  takeMesh(mesh: Mesh): Surface | undefined {
    const muscles = this.parts.filter((part) => part.kind === 'muscle').length;
    const part = this.parts[mesh.kind === 'skin' ? mesh.index : muscles + mesh.index];
    if (part === undefined || same(mesh.positions_m, this.surfaces[part.surface]?.rest_m)) return undefined;
    const surface = surfaceOf(part, mesh);
    this.surfaces[part.surface] = surface;
    if (mesh.kind === 'skin') this.skinGlides.set(part.surface, new Glide(surface.drawn_m, TREMBLE_M));
    return surface;
  }

  takePicture(picture: Picture, now_ms: number): void {
    this.beat.come(now_ms);
    for (const glide of [...this.skinGlides.values(), ...this.poseGlides]) glide.begin();
    for (const [index, skin] of picture.skins) this.takeSkin(index, skin);
    this.takePoses(picture.poses);
  }

  /** Goes on towards the newest picture. Gives the surfaces that moved; `posed`: bodies did. */
  advance(now_ms: number): { moved: Surface[]; posed: boolean } {
    const share = this.beat.share(now_ms);
    const moved: Surface[] = [];
    for (const [index, glide] of this.skinGlides) {
      const surface = this.surfaces[index]!;
      if (!glide.step(share)) continue;
      setNormals(surface);
      moved.push(surface);
    }
    let posed = false;
    for (const glide of this.poseGlides) posed = glide.step(share) || posed;
    return { moved, posed };
  }

  drawnPose(body: number): Float32Array {
    return this.poseGlides[body]?.drawn ?? IDENTITY;
  }

  newestPose(body: number): Float32Array {
    return this.newestPoses[body] ?? IDENTITY;
  }

  private takeSkin(index: number, skin: Float32Array): void {
    const surface = this.surfaces[index];
    const glide = this.skinGlides.get(index);
    if (surface === undefined || glide === undefined || skin.length !== surface.rest_m.length) return;
    surface.newest_m = skin;
    setSphere(surface);
    if (surface.known) glide.aim(skin);
    else glide.jump(skin);
    surface.known = true;
  }

  private takePoses(poses: Float32Array[]): void {
    if (this.poseGlides.length !== poses.length) {
      this.poseGlides = poses.map((pose) => new Glide(pose.slice(), POSE_TREMBLE));
      this.poseGlides.forEach((glide, body) => glide.jump(poses[body]!));
      for (const surface of this.surfaces) if (surface !== undefined && surface.body >= 0) surface.known = true;
    }
    poses.forEach((pose, body) => this.poseGlides[body]!.aim(pose));
    this.newestPoses = poses;
  }
}

function same(a: Float32Array, b: Float32Array | undefined): boolean {
  return a.length === b?.length && a.every((number, i) => number === b[i]);
}
