/** Reads what a step asks of the student; assets/lessons/README.md lists the tasks with their keys. */

import { nearestWord } from '../find/slips';
import type { Members, Place } from './json_place';
import { keyOf, partOfKey, samePart, type Anatomy, type Part, type Task, type TaskOf } from './lesson';

const LONGEST_HOLD_S = 60;
const KINDS = ['read', 'find', 'touch', 'name', 'press', 'predict', 'stiffen', 'identify'] as const;

type Keyed = readonly { key: string }[];

function requireKey(name: Place, parts: Keyed, kind: string): number {
  const key = name.string();
  const found = parts.findIndex((part) => part.key === key);
  if (found >= 0) return found;
  const nearest = nearestWord(
    key,
    parts.map((part) => part.key),
  );
  throw name.error(`the specimen has no ${kind} "${key.slice(0, 60)}"; the nearest is "${nearest}"`);
}

export function requireMuscle(name: Place, anatomy: Anatomy): number {
  return requireKey(name, anatomy.muscles, 'muscle');
}

export function requireBone(name: Place, anatomy: Anatomy): number {
  return requireKey(name, anatomy.bones, 'bone');
}

export function requirePart(name: Place, anatomy: Anatomy): Part {
  const found = partOfKey(anatomy, name.string());
  if (found) return found;
  const place = requireKey(name, [...anatomy.muscles, ...anatomy.bones], 'muscle or bone');
  return { kind: 'muscle', index: place };
}

function requireJoint(name: Place, anatomy: Anatomy): number {
  return requireKey(name, anatomy.joints, 'joint that rotates');
}

function readOptions(list: Place, right: Part, anatomy: Anatomy): Part[] {
  const FEWEST = 2;
  const MOST = 12;
  const options: Part[] = [];
  for (const element of list.elements()) {
    const option = requirePart(element, anatomy);
    if (options.some((other) => samePart(other, option))) throw element.error('is an option already; name each once');
    options.push(option);
  }
  if (options.length < FEWEST || options.length > MOST) {
    throw list.error(`has ${options.length} options; must have ${FEWEST} to ${MOST}`);
  }
  if (!options.some((option) => samePart(option, right))) {
    throw list.error(`lacks the right answer; add "${keyOf(anatomy, right)}"`);
  }
  return options;
}

function readName(task: Members, anatomy: Anatomy): Task {
  const part = requirePart(task.at('part'), anatomy);
  const options = task.find('options');
  const accept = task.find('accept');
  return {
    kind: 'name',
    part,
    options: options ? readOptions(options, part, anatomy) : [],
    accept: accept ? accept.strings() : [],
  };
}

function readHold(task: Members): number {
  return task.find('hold_s')?.numberBetween(0.1, LONGEST_HOLD_S) ?? 1;
}

function readPress(task: Members, anatomy: Anatomy): TaskOf<'press'> {
  // A student's device supports a few newtons; below a twentieth of one its friction hides the difference.
  const LEAST_N = 0.05;
  const MOST_N = 20;
  const muscle = requireMuscle(task.at('muscle'), anatomy);
  const band = task.at('band_N').elements(2);
  const [low_N, high_N] = band.map((edge) => edge.numberBetween(LEAST_N, MOST_N)) as [number, number];
  if (low_N >= high_N) throw task.at('band_N').error('must be [lowest, highest], the first below the second');
  return { kind: 'press', muscle, low_N, high_N, hold_s: readHold(task) };
}

function readPredict(task: Members, anatomy: Anatomy): TaskOf<'predict'> {
  // A fifth of a degree: a pull of 3 mm rotates a relaxed elbow by more, noise by a tenth of it.
  const TURN_RAD = 0.0035;
  return {
    kind: 'predict',
    muscle: requireMuscle(task.at('muscle'), anatomy),
    joint: requireJoint(task.at('joint'), anatomy),
    motion: task.at('motion').oneOf(['flexion', 'extension']),
    turn_rad: task.find('turn_rad')?.numberBetween(1e-4, 0.5) ?? TURN_RAD,
  };
}

function readStiffen(task: Members, anatomy: Anatomy): TaskOf<'stiffen'> {
  const WITHIN_RAD = 0.0349; // 2 degrees, which is not visible on a drawn limb
  const place = task.at('joint');
  const joint = requireJoint(place, anatomy);
  if (!anatomy.hasOpposingMuscles) {
    throw place.error('has no opposing muscles in this specimen; name a joint with flexors and extensors');
  }
  return {
    kind: 'stiffen',
    joint,
    factor: task.at('factor').numberBetween(1.1, 100),
    within_rad: task.find('within_rad')?.numberBetween(1e-3, 0.5) ?? WITHIN_RAD,
    hold_s: readHold(task),
  };
}

function readKind(kind: (typeof KINDS)[number], task: Members, anatomy: Anatomy): Task {
  switch (kind) {
    case 'read':
      return { kind };
    case 'find':
    case 'touch':
      return { kind, part: requirePart(task.at('part'), anatomy) };
    case 'name':
      return readName(task, anatomy);
    case 'press':
      return readPress(task, anatomy);
    case 'predict':
      return readPredict(task, anatomy);
    case 'stiffen':
      return readStiffen(task, anatomy);
    case 'identify': {
      const part = requirePart(task.at('part'), anatomy);
      return { kind, part, options: readOptions(task.at('options'), part, anatomy) };
    }
  }
}

/** A step's `task`; throws BadLesson. */
export function readTask(value: Place, anatomy: Anatomy): Task {
  const members = value.object();
  const task = readKind(members.at('kind').oneOf(KINDS), members, anatomy);
  members.finish();
  return task;
}
