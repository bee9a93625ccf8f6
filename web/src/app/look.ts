/** How the limb is drawn: the view that an instructor can send to all, and that a lesson's step sets. */

/** Parts that are not named are shown. */
export type Shown = 'faded' | 'hidden';
export type Colouring = 'own' | 'kind' | 'activation' | 'tension';
export type Names = 'english' | 'latin' | 'none';

export interface Look {
  /** By key of the part. */
  parts: Record<string, Shown>;
  /** Only these are drawn, the others hidden; null: all. */
  only: string[] | null;
  /** How solid each layer is, 0 (gone) to 1. */
  layers: { superficial: number; deep: number; bones: number };
  colour: Colouring;
  labels: boolean;
  names: Names;
  /** Drawn as selected, though its name may not be known yet: what a quiz asks about. */
  marked: string | null;
  /** Muscle lines. */
  lines: boolean;
}

export function plainLook(): Look {
  return {
    parts: {},
    only: null,
    layers: { superficial: 1, deep: 1, bones: 1 },
    colour: 'own',
    labels: false,
    names: 'english',
    marked: null,
    lines: false,
  };
}

/** Metres, world frame: x cranial, y left, z up. */
export interface CameraPose {
  eye: [number, number, number];
  target: [number, number, number];
}

export type Side = 'lateral' | 'medial' | 'cranial' | 'caudal' | 'dorsal' | 'palmar';

export interface Camera {
  pose(): CameraPose;
  /** Eases there; at once with `seconds` 0. */
  moveTo(pose: CameraPose, seconds?: number): void;
  showFrom(side: Side): void;
  /** Comes near a part; null: the whole limb. */
  frame(key: string | null): void;
}
