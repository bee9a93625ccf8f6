/**
 * What every part of the page sees of the whole: the newest of everything that came, what the person chose, and how to
 * hear of changes. Panels get an `App` and nothing else.
 */
import type { Part, SceneFacts } from './facts';
import type { Camera, Look } from './look';
import type { InForce, Picture, Readings } from '../wire/moment';

export type Role = 'viewer' | 'student' | 'instructor';
export type Mode = 'look' | 'touch' | 'pull';

export interface Me {
  client: number;
  name: string;
  role: Role;
  /** Index of the scene's tool; -1: this page only watches. */
  hand: number;
}

export type Connection =
  | { state: 'joining' }
  | { state: 'joined' }
  /** The page tries again by itself; `key` of the sentence that says why. */
  | { state: 'broken'; key: string }
  /** For good; `key` of the sentence that says why. */
  | { state: 'ended'; key: string }
  /** A recording is played: nobody hears what is sent. */
  | { state: 'playing' };

export interface Member {
  id: number;
  name: string;
  role: Role;
  hand: number;
  hand_up: boolean;
  answer: string | null;
}

export interface ClassResult {
  /** Rising; of a step that was sent twice the later one counts. */
  number: number;
  client: number;
  name: string;
  lesson: string;
  step: number;
  answer: string;
  points: number;
  of: number;
  /** That this is an answer to; a lesson's step has none. */
  question?: Question;
}

export interface Question {
  id: string;
  text: string;
  options: string[];
}

export interface ClassState {
  frozen: boolean;
  /** What the instructor sent with `class_look`; judge it before use. */
  look: unknown;
  question: Question | null;
  lesson: string | null;
  students: number;
  you: { hand_up: boolean };
  /** These three come to instructors only: the link that students open, who is there, what came of lessons. */
  join?: string;
  members?: Member[];
  results?: ClassResult[];
}

/** What this page's hand does and feels now. */
export interface Touch {
  /** Part under the tool while it is in contact, or null. */
  part: string | null;
  /** As the server answered it, smoothed [N]; 0 without contact or line. */
  force_N: number;
  /** How deep the hand is below the skin [m]. */
  depth_m: number;
  /** Muscle whose line is in hand, or null; where along it, 0 origin to 1 insertion; its tension. */
  line: string | null;
  fraction: number;
  tension_N: number;
}

/** A click on the limb in Look mode, or on a muscle's button. */
export interface Picked {
  key: string | null;
  point_m: [number, number, number] | null;
}

export interface AppEvents {
  picture: Picture;
  readings: Readings;
  inForce: InForce;
  class: ClassState;
  /** Any Control of the server, parsed; `class` comes by its own event, too. */
  control: Record<string, unknown>;
  connection: Connection;
  me: Me;
  look: Look;
  selection: string | null;
  picked: Picked;
  mode: Mode;
  touch: Touch;
  language: string;
}

export type PanelSide = 'left' | 'right';

/** Sees every frame of the server as it came, header and all. */
export type FrameTap = (frame: Uint8Array, at_ms: number) => void;

/** Made by `createTexts` of text/texts.ts. */
export interface Texts {
  readonly language: string;
  readonly languages: readonly string[];
  /** The text of a key with its placeholders filled; the key itself where there is none. */
  t(key: string, ...values: (string | number)[]): string;
  has(key: string): boolean;
  /** Sets the element's text now and whenever another language is chosen. Gives the element back. */
  bind<E extends Element>(element: E, key: string, ...values: (string | number)[]): E;
  /** The same for an attribute (`title`, `aria-label`, `placeholder`). */
  bindAttribute<E extends Element>(element: E, attribute: string, key: string, ...values: (string | number)[]): E;
  choose(language: string): void;
  onChange(listener: (language: string) => void): () => void;
}

export interface App {
  readonly texts: Texts;
  readonly scene: SceneFacts;
  /** Of `/lessons.json`, as they came. */
  readonly lessons: readonly unknown[];
  /** In the order of surfaces: muscles, then bones. */
  readonly parts: readonly Part[];
  part(key: string): Part | undefined;
  /** What a part is called in the page's choice of names. */
  nameOf(key: string): string;

  /** Body that carries a bone, by its index among the bones; -1: not known yet. Bones of one body move as one. */
  bodyOfBone(bone: number): number;

  readonly me: Me;
  readonly connection: Connection;
  readonly readings: Readings | null;
  readonly inForce: InForce | null;
  readonly classState: ClassState | null;
  readonly touch: Touch;

  readonly look: Look;
  setLook(change: Partial<Look>): void;
  readonly selection: string | null;
  select(key: string | null): void;
  readonly mode: Mode;
  setMode(mode: Mode): void;
  readonly camera: Camera;

  /** Sends a Control. */
  send(control: object): void;
  /** Gives back what stops the listening. */
  on<K extends keyof AppEvents>(event: K, listener: (value: AppEvents[K]) => void): () => void;

  /** A folding panel; those of a side stand in the order of `order`, lowest first. Gives back what takes it away. */
  mountPanel(side: PanelSide, id: string, titleKey: string, element: HTMLElement, options?: PanelOptions): () => void;
  /** Unfolds a panel and brings it into view; on a phone its sheet, too. */
  reveal(id: string): void;
  /** A control in the bar above the limb, at its right end. */
  mountTool(element: HTMLElement): void;
  /** Something over the middle of the limb (a question, a sentence), shown until the returned function is called. */
  mountOver(element: HTMLElement): () => void;
  /** A sentence that goes away by itself. */
  toast(text: string): void;

  tapFrames(tap: FrameTap): () => void;
  /** The frames that somebody who begins to look now needs first, beside a whole picture: what the scene is, meshes. */
  primingFrames(): Uint8Array[];
  /** The newest picture as a frame that needs none before it; null before the first. */
  wholePicture(): Uint8Array | null;
}

export interface PanelOptions {
  order?: number;
  /** Folded at first. */
  folded?: boolean;
}
