/** The limb's surfaces as three.js draws them. */
import { BufferAttribute, BufferGeometry, DynamicDrawUsage, Mesh, Object3D, StaticDrawUsage } from 'three';
import type { Look } from '../app/look';
import type { Readings } from '../wire/moment';
import { laidOver } from './colours';
import { boneMaterial, fleshMaterial, setSolid, type LimbMaterial } from './material';
import type { LimbModel } from './model';
import { strandsOf } from './strands';
import type { Surface } from './surface';
import { solidity } from './visibility';

export interface Marks {
  selected: string | null;
  hovered: string | null;
}

export class LimbDrawing {
  readonly group = new Object3D();
  readonly meshes: (Mesh<BufferGeometry, LimbMaterial> | undefined)[] = [];

  constructor(private readonly model: LimbModel) {}

  /** `shade`: of each vertex, 255 under the open sky. */
  add(surface: Surface, shade: Uint8Array | null): void {
    const { part } = surface;
    this.remove(part.surface);
    const geometry = new BufferGeometry();
    const usage = part.kind === 'muscle' ? DynamicDrawUsage : StaticDrawUsage;
    geometry.setAttribute('position', new BufferAttribute(surface.drawn_m, 3).setUsage(usage));
    geometry.setAttribute('normal', new BufferAttribute(surface.normals, 3).setUsage(usage));
    const count = surface.rest_m.length / 3;
    geometry.setAttribute('shade', new BufferAttribute(shade ?? new Uint8Array(count).fill(255), 1, true));
    geometry.setIndex(new BufferAttribute(indexOf(surface.triangles, count), 1));
    const material = part.kind === 'muscle' ? fleshMaterial(part.key) : boneMaterial();
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.matrixAutoUpdate = false;
    mesh.visible = false;
    this.meshes[part.surface] = mesh;
    this.group.add(mesh);
  }

  setShade(surface: Surface, shade: Uint8Array): void {
    this.meshes[surface.part.surface]?.geometry.setAttribute('shade', new BufferAttribute(shade, 1, true));
  }

  /** Takes over where the surfaces moved. Without readings there are no lines yet, and so no strands. */
  follow(moved: Surface[], posed: boolean, readings: Readings | null): void {
    for (const surface of moved) this.followSkin(surface, readings);
    if (posed) for (const surface of this.model.surfaces) if (surface !== undefined) this.place(surface);
  }

  applyLook(look: Look, marks: Marks, readings: Readings | null, accent: [number, number, number]): void {
    for (const surface of this.model.surfaces) {
      const mesh = surface && this.meshes[surface.part.surface];
      if (surface === undefined || mesh === undefined) continue;
      const solid = solidity(surface.part, look);
      mesh.visible = surface.known && solid > 0.01;
      setSolid(mesh.material, solid);
      mesh.renderOrder = solid < 1 ? 1 : 0;
      laidOver(surface.part, look.colour, readings, mesh.material.uniforms.laid_over.value);
      mesh.material.uniforms.mark.value.set(...accent, markShare(surface.part.key, look, marks));
    }
  }

  private followSkin(surface: Surface, readings: Readings | null): void {
    const mesh = this.meshes[surface.part.surface];
    if (mesh === undefined) return;
    mesh.geometry.attributes['position']!.needsUpdate = true;
    mesh.geometry.attributes['normal']!.needsUpdate = true;
    if (mesh.geometry.attributes['strand'] === undefined) this.addStrands(surface, mesh.geometry, readings);
  }

  private addStrands(surface: Surface, geometry: BufferGeometry, readings: Readings | null): void {
    const line = readings?.lines_m[surface.part.index];
    if (line === undefined || line.length < 6) return;
    const { coordinates, tendon } = strandsOf(surface, line);
    geometry.setAttribute('strand', new BufferAttribute(coordinates, 3));
    geometry.setAttribute('tendon', new BufferAttribute(tendon, 1));
  }

  private place(surface: Surface): void {
    const mesh = this.meshes[surface.part.surface];
    if (mesh === undefined || surface.body < 0) return;
    const p = this.model.drawnPose(surface.body) as unknown as number[];
    mesh.matrix.set(p[0]!, p[1]!, p[2]!, p[3]!, p[4]!, p[5]!, p[6]!, p[7]!, p[8]!, p[9]!, p[10]!, p[11]!, 0, 0, 0, 1);
    mesh.matrixWorldNeedsUpdate = true;
  }

  private remove(index: number): void {
    const mesh = this.meshes[index];
    if (mesh === undefined) return;
    this.group.remove(mesh);
    mesh.geometry.dispose();
    mesh.material.dispose();
  }
}

function markShare(key: string, look: Look, { selected, hovered }: Marks): number {
  if (key === selected || key === look.marked) return 0.75;
  return key === hovered ? 0.35 : 0;
}

function indexOf(triangles: Uint32Array, vertices: number): Uint16Array | Uint32Array {
  return vertices < 65536 ? Uint16Array.from(triangles) : triangles;
}
