/** Where the limb is looked at from, and the gestures that change it. */
import CameraControls from 'camera-controls';
import {
  Box3,
  MathUtils,
  Matrix4,
  PerspectiveCamera,
  Quaternion,
  Raycaster,
  Sphere,
  Spherical,
  Vector2,
  Vector3,
  Vector4,
} from 'three';
import type { Camera, CameraPose, Side } from '../app/look';
import type { LimbModel } from './model';
import { add, placed, scale, type Point } from './vectors';

CameraControls.install({
  THREE: { Box3, MathUtils, Matrix4, Quaternion, Raycaster, Sphere, Spherical, Vector2, Vector3, Vector4 },
});

const FIELD_OF_VIEW_DEG = 28;
/** The limb fills so much of the smaller edge. */
const FILLED = 0.9;
const EASE_S = 0.25;
/** No nearer than this, where the tool would fill the picture [m]. */
const NEAREST_M = 0.03;

/** From the limb to the eye. A left limb: lateral is left. */
const sides: Record<Side, Point> = {
  lateral: [0, 1, 0],
  medial: [0, -1, 0],
  cranial: [1, 0, 0],
  caudal: [-1, 0, 0],
  dorsal: [0.35, 0, 0.94],
  palmar: [-0.5, 0, -0.87],
};

export class LimbCamera implements Camera {
  readonly three = new PerspectiveCamera(FIELD_OF_VIEW_DEG, 1, 0.01, 20);
  readonly controls: CameraControls;
  private side: Side = 'lateral';
  private framed = false;

  constructor(
    element: HTMLElement,
    private readonly model: LimbModel,
    private readonly calm: boolean,
  ) {
    this.three.up.set(0, 0, 1);
    this.controls = new CameraControls(this.three, element);
    this.controls.updateCameraUp();
    this.controls.smoothTime = EASE_S;
    this.controls.draggingSmoothTime = 0.06;
    this.controls.minDistance = NEAREST_M;
    this.controls.maxDistance = 6;
    this.controls.dollyToCursor = true;
    this.controls.mouseButtons.right = CameraControls.ACTION.TRUCK;
    this.controls.touches.two = CameraControls.ACTION.TOUCH_DOLLY_TRUCK;
  }

  resize(width: number, height: number): void {
    this.three.aspect = width / Math.max(1, height);
    this.three.updateProjectionMatrix();
  }

  /** The first time that there is a limb to see. */
  begin(): void {
    if (!this.framed) this.framed = this.showFrom(this.side, 0);
  }

  pose(): CameraPose {
    const eye = this.controls.getPosition(new Vector3());
    const target = this.controls.getTarget(new Vector3());
    return { eye: eye.toArray(), target: target.toArray() };
  }

  moveTo({ eye, target }: CameraPose, seconds = 0.6): void {
    this.controls.smoothTime = seconds / 2.5;
    void this.controls.setLookAt(...eye, ...target, seconds > 0 && !this.calm);
    this.controls.smoothTime = EASE_S;
  }

  showFrom(side: Side, seconds = 0.6): boolean {
    const sphere = this.sphereOf(null);
    if (sphere === null) return false;
    this.side = side;
    const eye = add(sphere.centre, scale(sides[side], this.distanceFor(sphere.radius)));
    this.moveTo({ eye, target: sphere.centre }, seconds);
    return true;
  }

  frame(key: string | null, seconds = 0.6): boolean {
    const sphere = this.sphereOf(key);
    if (sphere === null) return false;
    const { eye, target } = this.pose();
    const away: Point = [eye[0] - target[0], eye[1] - target[1], eye[2] - target[2]];
    const size = Math.hypot(...away);
    const direction: Point = size < 1e-6 ? sides[this.side] : scale(away, 1 / size);
    const distance_m = this.distanceFor(sphere.radius * (key === null ? 1 : 1.4));
    this.moveTo({ eye: add(sphere.centre, scale(direction, distance_m)), target: sphere.centre }, seconds);
    return true;
  }

  private distanceFor(radius_m: number): number {
    const half = MathUtils.degToRad(FIELD_OF_VIEW_DEG / 2);
    const narrow = Math.min(1, this.three.aspect * 1.6);
    return radius_m / Math.sin(half) / FILLED / narrow;
  }

  /** Round what is known of one part or of all. */
  private sphereOf(key: string | null): { centre: Point; radius: number } | null {
    const box = new Box3();
    for (const surface of this.model.surfaces) {
      if (surface === undefined || !surface.known || (key !== null && surface.part.key !== key)) continue;
      const { centre, radius } = surface.sphere;
      const place = surface.body < 0 ? centre : placed(this.model.newestPose(surface.body), centre);
      for (let i = 0; i < surface.newest_m.length; i += 15) {
        const p: Point = [surface.newest_m[i]!, surface.newest_m[i + 1]!, surface.newest_m[i + 2]!];
        box.expandByPoint(new Vector3(...(surface.body < 0 ? p : placed(this.model.newestPose(surface.body), p))));
      }
      if (key !== null) return { centre: place, radius };
    }
    if (box.isEmpty()) return null;
    const size = box.getSize(new Vector3());
    return { centre: box.getCenter(new Vector3()).toArray(), radius: Math.max(size.x, size.y, size.z) / 2 };
  }
}
