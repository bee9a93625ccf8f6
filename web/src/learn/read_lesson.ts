/** Reads a lesson of /lessons.json and checks it against the scene, as the window does with its files. */

import { Place, type Members } from './json_place';
import { COLOURS, VIEWS, type Anatomy, type Lesson, type Setting, type Show, type Step } from './lesson';
import { readTask, requireBone, requireMuscle, requirePart } from './read_task';

const SCHEMA = 1;
const TITLE = 120; // letters
const TEXT = 4000;

/** A lesson that can be played, or one sentence on why not. */
export type ListedLesson =
  | { lesson: Lesson; complaint: null; name: string }
  | { lesson: null; complaint: string; name: string };

function readShow(value: Place | null, anatomy: Anatomy): Show {
  const show: Show = { muscles: null, bones: null, faded: [], colour: 'activation', labels: false };
  if (!value) return show;
  const members = value.object();
  show.muscles =
    members
      .find('muscles')
      ?.elements()
      .map((key) => requireMuscle(key, anatomy)) ?? null;
  show.bones =
    members
      .find('bones')
      ?.elements()
      .map((key) => requireBone(key, anatomy)) ?? null;
  show.faded =
    members
      .find('faded')
      ?.elements()
      .map((key) => requirePart(key, anatomy)) ?? [];
  show.colour = members.find('colour')?.oneOf(COLOURS) ?? show.colour;
  show.labels = members.find('labels')?.boolean() ?? false;
  members.finish();
  return show;
}

function readSetting(value: Place | null): Setting {
  const set: Setting = {};
  if (!value) return set;
  const members = value.object();
  const number = (key: 'common' | 'difference' | 'flexors' | 'extensors', lowest: number) => {
    const found = members.find(key);
    if (found) set[key] = found.numberBetween(lowest, 1);
  };
  number('common', 0);
  number('difference', -1);
  number('flexors', 0);
  number('extensors', 0);
  if ((set.flexors === undefined) !== (set.extensors === undefined)) {
    throw value.error('levels come in pairs; give both "flexors" and "extensors"');
  }
  if (set.flexors !== undefined && (set.common !== undefined || set.difference !== undefined)) {
    throw value.error('give either levels ("flexors", "extensors") or a balance ("common", "difference")');
  }
  for (const key of ['hold_posture', 'gravity'] as const) {
    const found = members.find(key);
    if (found) set[key] = found.boolean();
  }
  members.finish();
  return set;
}

function readHints(list: Place | null): string[] {
  const MOST = 4; // each takes a quarter of the points
  if (!list) return [];
  const hints = list.elements().map((hint) => hint.text(TEXT));
  if (hints.length > MOST) throw list.error(`has ${hints.length} hints; must have at most ${MOST}`);
  return hints;
}

function readPoints(members: Members, onlyRead: boolean): number {
  const points = members.find('points');
  if (!points) return onlyRead ? 0 : 1;
  const value = points.numberBetween(0, 100);
  if (onlyRead && value > 0) throw points.error('reading earns no points; give the step a task, or 0');
  return value;
}

function readStep(value: Place, anatomy: Anatomy): Step {
  const members = value.object();
  const title = members.at('title').text(TITLE);
  const text = members.at('text').text(TEXT);
  const view = members.find('view')?.oneOf(VIEWS) ?? null;
  const show = readShow(members.find('show'), anatomy);
  const set = readSetting(members.find('set'));
  const task = members.find('task');
  const read = task ? readTask(task, anatomy) : ({ kind: 'read' } as const);
  const hints = readHints(members.find('hints'));
  const points = readPoints(members, read.kind === 'read');
  members.finish();
  return { title, text, view, show, set, task: read, hints, points };
}

/** Before anything else, so that a lesson of another version is refused as one and not for an unknown key. */
function requireSchema(members: Members): void {
  const schema = members.at('schema');
  const version = schema.number();
  if (version === SCHEMA) return;
  const remedy =
    version > SCHEMA
      ? 'get a newer Myotact, or ask the author for a lesson of this version'
      : 'write "schema": 1 and check the lesson again';
  throw schema.error(`the lesson is of version ${version}, this program reads version ${SCHEMA}; ${remedy}`);
}

function readKey(value: Place): string {
  const key = value.string();
  if (!/^[a-z0-9_-]{1,60}$/.test(key)) {
    throw value.error('must be 1 to 60 small letters, digits, _ or -, for example "my_quiz"');
  }
  return key;
}

/** Throws BadLesson, which names place, value and what is allowed. */
export function readLesson(json: unknown, anatomy: Anatomy): Lesson {
  const MOST_STEPS = 200;
  const members = new Place(json).object();
  requireSchema(members);
  const key = readKey(members.at('key'));
  const title = members.at('title').text(TITLE);
  const scene = members.at('scene').text(TEXT);
  const author = members.find('author')?.string() ?? '';
  const language = members.find('language')?.string() ?? 'en';
  const sources = members.find('sources')?.strings() ?? [];
  const list = members.at('steps');
  const places = list.elements();
  if (places.length === 0 || places.length > MOST_STEPS) {
    throw list.error(`has ${places.length} steps; must have 1 to ${MOST_STEPS}`);
  }
  members.finish();
  const steps = places.map((step) => readStep(step, anatomy));
  return { key, title, scene, author, language, sources, steps };
}

function nameOf(json: unknown, place: number): string {
  const { title, key } = (json ?? {}) as { title?: unknown; key?: unknown };
  const name = [title, key].find((text) => typeof text === 'string' && text.trim() !== '');
  return typeof name === 'string' ? name.slice(0, TITLE) : `${place + 1}`;
}

/** The lessons of a class, broken ones with what is wrong with them. */
export function readLessons(json: unknown, anatomy: Anatomy): ListedLesson[] {
  if (!Array.isArray(json)) return [];
  return json.map((entry: unknown, place): ListedLesson => {
    const name = nameOf(entry, place);
    try {
      return { lesson: readLesson(entry, anatomy), complaint: null, name };
    } catch (failure) {
      return { lesson: null, complaint: failure instanceof Error ? failure.message : String(failure), name };
    }
  });
}
