/** A limb of ellipsoids with the parts of the canine elbow: enough to see, click, touch and pull. */

import type { BoneFacts, Group, MuscleFacts, SceneFacts } from '../../src/app/facts';
import { ByteWriter } from '../../src/wire/cursor';
import { GRID_M } from '../../src/wire/picture';
import { elbow } from '../elbow';

type Place = [number, number, number];

interface Ellipsoid {
  centre_m: Place;
  radii_m: Place;
}

const FLEXORS = ['biceps_brachii', 'brachialis'];
const bone = (centre_m: Place, radii_m: Place): Ellipsoid => ({ centre_m, radii_m });
const BONES = [
  bone([0, 0, 0.36], [0.02, 0.01, 0.05]),
  bone([0, 0, 0.25], [0.012, 0.012, 0.07]),
  bone([0.008, 0, 0.1], [0.007, 0.008, 0.07]),
  bone([-0.01, 0, 0.11], [0.007, 0.008, 0.085]),
  bone([0, 0, 0.0], [0.01, 0.012, 0.035]),
];
const MUSCLES = elbow.muscles.map(({ key }, i): Ellipsoid => {
  const side = FLEXORS.includes(key) ? 1 : -1;
  return {
    centre_m: [side * (0.03 + 0.004 * (i % 2)), 0.022 * (i % 3) - 0.022, 0.2 + 0.02 * i],
    radii_m: [0.012, 0.01, 0.04],
  };
});
const RINGS = 10;
const SPOKES = 14;

function vertices({ centre_m, radii_m }: Ellipsoid): number[] {
  const places: number[] = [];
  for (let ring = 0; ring <= RINGS; ++ring) {
    const down = (Math.PI * ring) / RINGS;
    for (let spoke = 0; spoke < SPOKES; ++spoke) {
      const round = (2 * Math.PI * spoke) / SPOKES;
      const unit = [Math.sin(down) * Math.cos(round), Math.sin(down) * Math.sin(round), Math.cos(down)];
      places.push(...unit.map((x, axis) => (centre_m[axis] ?? 0) + (radii_m[axis] ?? 0) * x));
    }
  }
  return places;
}

function triangles(): number[] {
  const corners: number[] = [];
  for (let ring = 0; ring < RINGS; ++ring) {
    for (let spoke = 0; spoke < SPOKES; ++spoke) {
      const [a, b] = [ring * SPOKES + spoke, ring * SPOKES + ((spoke + 1) % SPOKES)];
      corners.push(a, a + SPOKES, b, b, a + SPOKES, b + SPOKES);
    }
  }
  return corners;
}

/** Payloads of the Mesh frames: muscles, then bones. */
export function meshes(): Uint8Array[] {
  const corners = triangles();
  const mesh = (kind: number, body: (index: number) => number) => (shape: Ellipsoid, index: number) => {
    const places = vertices(shape);
    const writer = new ByteWriter(new Uint8Array(15 + 4 * (places.length + corners.length)));
    writer
      .u8(kind)
      .u16(index)
      .i32(body(index))
      .u32(places.length / 3)
      .u32(corners.length / 3)
      .f32(...places);
    for (const corner of corners) writer.u32(corner);
    return writer.written();
  };
  return [...MUSCLES.map(mesh(0, () => -1)), ...BONES.map(mesh(1, (index) => [0, 1, 2, 2, 3][index] ?? 0))];
}

/** The muscles as pictures have them: on the grid, all x, then all y, then all z. */
export function skins(): Map<number, Int32Array> {
  return new Map(
    MUSCLES.map((shape, index) => {
      const places = vertices(shape);
      const axis = (which: number) => places.filter((_, i) => i % 3 === which).map((x) => Math.round(x / GRID_M));
      return [index, Int32Array.from([...axis(0), ...axis(1), ...axis(2)])];
    }),
  );
}

/** From the upper end to the lower, three points a muscle. */
export function lines(): Place[][] {
  return MUSCLES.map(({ centre_m: [x, y, z] }) => [
    [x, y, z + 0.05],
    [x, y, z],
    [x, y, z - 0.05],
  ]);
}

export const BODIES = 4;

export function sceneFacts(): SceneFacts {
  const names = ({ key, english, latin, synonyms }: (typeof elbow.muscles)[number]) => {
    return { key, english, latin, synonyms: [...synonyms], region: 'arm' };
  };
  const muscle = (part: (typeof elbow.muscles)[number]): MuscleFacts => {
    const group: Group = FLEXORS.includes(part.key) ? 'flexor' : 'extensor';
    const words = {
      function: `${group} of the elbow`,
      origin: 'humerus',
      insertion: 'ulna',
      action: '',
      innervation: '',
    };
    return {
      ...names(part),
      ...words,
      layer: 'superficial',
      group,
      peak_force_N: 100,
      optimal_fibre_m: 0.02,
      simulated: true,
    };
  };
  const preset = (name: string, common: number) => ({ name, common, difference: 0 });
  return {
    ...{ version: '0.2.0', name: 'elbow', title: 'A limb for tests', note: '' },
    muscles: elbow.muscles.map(muscle),
    bones: elbow.bones.map((part): BoneFacts => names(part)),
    joints: elbow.joints.map(({ key }) => ({ key })),
    co_contraction: { joint: 'elbow', presets: [preset('rest', 0), preset('light', 0.25), preset('firm', 1)] },
  };
}
