/** What the server tells of the scene in `/scene.json`, and the parts as the page numbers them. */

export type Layer = 'superficial' | 'deep';
export type Group = 'flexor' | 'extensor' | 'other';

export interface MuscleFacts {
  key: string;
  english: string;
  latin: string;
  synonyms: string[];
  region: string;
  layer: Layer;
  function: string;
  group: Group;
  origin: string;
  insertion: string;
  action: string;
  innervation: string;
  peak_force_N: number;
  optimal_fibre_m: number;
  /** Only these give under the tool. */
  simulated: boolean;
}

export interface BoneFacts {
  key: string;
  english: string;
  latin: string;
  synonyms: string[];
  region: string;
}

export interface JointFacts {
  key: string;
}

export interface Preset {
  name: string;
  common: number;
  difference: number;
}

export interface SceneFacts {
  version: string;
  name: string;
  title: string;
  note: string;
  muscles: MuscleFacts[];
  bones: BoneFacts[];
  joints: JointFacts[];
  co_contraction: { joint: string; presets: Preset[] } | null;
}

/** A muscle or a bone. Keys are unique among both. */
export type Part = MusclePart | BonePart;

export interface MusclePart extends MuscleFacts {
  kind: 'muscle';
  /** Among the muscles. */
  index: number;
  /** As the wire numbers surfaces: muscles, then bones. */
  surface: number;
}

export interface BonePart extends BoneFacts {
  kind: 'bone';
  /** Among the bones. */
  index: number;
  surface: number;
}

/** Muscles, then bones: a part's place here is the number of its surface. */
export function partsOf(facts: SceneFacts): Part[] {
  const muscles = facts.muscles.map((muscle, index): Part => ({ ...muscle, kind: 'muscle', index, surface: index }));
  const bones = facts.bones.map((bone, index): Part => {
    return { ...bone, kind: 'bone', index, surface: muscles.length + index };
  });
  return [...muscles, ...bones];
}
