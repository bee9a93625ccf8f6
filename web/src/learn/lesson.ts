/** A lesson as data: what /lessons.json holds, with every name resolved against the scene's parts. */

import type { NamedPart } from '../find/search';

export interface Part {
  kind: 'muscle' | 'bone';
  index: number;
}

/** What a lesson needs to know of the scene. */
export interface Anatomy {
  muscles: readonly NamedPart[];
  bones: readonly NamedPart[];
  joints: readonly { key: string }[];
  hasOpposingMuscles: boolean; // without them no joint can be stiffened
}

export type Motion = 'flexion' | 'extension';

export type Task =
  | { kind: 'read' }
  | { kind: 'find'; part: Part }
  | { kind: 'touch'; part: Part }
  | { kind: 'name'; part: Part; options: Part[]; accept: string[] }
  | { kind: 'press'; muscle: number; low_N: number; high_N: number; hold_s: number }
  | { kind: 'predict'; muscle: number; joint: number; motion: Motion; turn_rad: number }
  | { kind: 'stiffen'; joint: number; factor: number; within_rad: number; hold_s: number }
  | { kind: 'identify'; part: Part; options: Part[] };

export type TaskOf<Kind extends Task['kind']> = Extract<Task, { kind: Kind }>;

export const COLOURS = ['kind', 'activation', 'tension', 'stretch', 'pressure'] as const;
export const VIEWS = ['lateral', 'medial', 'cranial', 'caudal', 'dorsal', 'palmar'] as const;

/** How the limb is to look in a step. */
export interface Show {
  muscles: number[] | null; // only these; null: all
  bones: number[] | null;
  faded: Part[];
  colour: (typeof COLOURS)[number];
  labels: boolean;
}

/** What is set of the scene when a step begins; what is not named stays. */
export interface Setting {
  common?: number;
  difference?: number;
  flexors?: number;
  extensors?: number;
  hold_posture?: boolean;
  gravity?: boolean;
}

export interface Step {
  title: string;
  text: string;
  view: (typeof VIEWS)[number] | null; // null: as it is
  show: Show;
  set: Setting;
  task: Task;
  hints: string[]; // shown one by one
  points: number;
}

export interface Lesson {
  key: string;
  title: string;
  scene: string;
  author: string;
  language: string;
  sources: string[];
  steps: Step[]; // at least one
}

export function samePart(a: Part | null, b: Part | null): boolean {
  return a === b || (a !== null && b !== null && a.kind === b.kind && a.index === b.index);
}

export function partsOf(anatomy: Anatomy, kind: Part['kind']): readonly NamedPart[] {
  return kind === 'muscle' ? anatomy.muscles : anatomy.bones;
}

export function keyOf(anatomy: Anatomy, part: Part | null): string {
  return part === null ? '' : (partsOf(anatomy, part.kind)[part.index]?.key ?? '');
}

export function partOfKey(anatomy: Anatomy, key: string): Part | null {
  const muscle = anatomy.muscles.findIndex((part) => part.key === key);
  if (muscle >= 0) return { kind: 'muscle', index: muscle };
  const bone = anatomy.bones.findIndex((part) => part.key === key);
  return bone >= 0 ? { kind: 'bone', index: bone } : null;
}

export function mostPoints(lesson: Lesson): number {
  return lesson.steps.reduce((sum, step) => sum + step.points, 0);
}

/** Names stay hidden while a task asks for them. */
export function hidesNames(task: Task): boolean {
  return ['find', 'name', 'predict', 'identify'].includes(task.kind);
}

/** What the task is about, where to find it is not the task. */
export function markedPart(task: Task): Part | null {
  if (task.kind === 'name') return task.part;
  if (task.kind === 'press' || task.kind === 'predict') return { kind: 'muscle', index: task.muscle };
  return null;
}

/** What the pointer does at the start of a step. */
export function pointerModeFor(task: Task): 'look' | 'touch' | 'pull' {
  if (task.kind === 'predict') return 'pull';
  return ['touch', 'press', 'identify'].includes(task.kind) ? 'touch' : 'look';
}
