/** Muscle lines: of all when the look has them, of the one in hand always. */
import { BufferAttribute, BufferGeometry, LineBasicMaterial, LineSegments, Object3D } from 'three';
import type { Readings } from '../wire/moment';

const COLOUR = 0x11556b;

export class LinesDrawing {
  readonly group = new Object3D();
  private readonly segments: LineSegments;

  constructor() {
    const material = new LineBasicMaterial({ color: COLOUR, depthTest: false, transparent: true, opacity: 0.9 });
    this.segments = new LineSegments(new BufferGeometry(), material);
    this.segments.frustumCulled = false;
    this.segments.renderOrder = 2;
    this.group.add(this.segments);
  }

  show(readings: Readings | null, wanted: (muscle: number) => boolean): void {
    const places: number[] = [];
    readings?.lines_m.forEach((line, muscle) => {
      if (!wanted(muscle)) return;
      for (let i = 0; i + 5 < line.length; i += 3) places.push(...line.subarray(i, i + 6));
    });
    this.segments.visible = places.length > 0;
    this.segments.geometry.dispose();
    this.segments.geometry = new BufferGeometry();
    this.segments.geometry.setAttribute('position', new BufferAttribute(Float32Array.from(places), 3));
  }
}
