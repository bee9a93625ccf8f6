/**
 * What a student sees and does of a task. What changes with the readings, five times a second, is kept up by the
 * returned functions.
 */

import { el } from '../app/dom';
import type { App } from '../app/state';
import { keyOf, partOfKey, type Motion, type Part, type Task, type TaskOf } from './lesson';
import type { LessonSession } from './lesson_session';
import type { TaskState } from './task_state';
import { bandBar, paragraph, shareBar, textButton, type Live } from './widgets';

const DEGREES = 180 / Math.PI;

/** What the views of all tasks need. */
interface Scribe {
  app: App;
  session: LessonSession;
  t: App['texts']['t'];
  state: TaskState;
}

function nameOf({ session }: Scribe, part: Part): string {
  return session.nameOf(keyOf(session.anatomy, part));
}

function muscleName(s: Scribe, index: number): string {
  return nameOf(s, { kind: 'muscle', index });
}

function jointName({ app, session }: Scribe, joint: number): string {
  const key = session.anatomy.joints[joint]?.key ?? '';
  return app.texts.has(`web.joint.${key}`) ? app.texts.t(`web.joint.${key}`) : key;
}

function timeHeld(s: Scribe, hold_s: number): Live {
  return shareBar(() => {
    const held_s = Math.min(s.state.held_s, hold_s);
    return { share: held_s / hold_s, text: s.t('learn.held', held_s, hold_s) };
  });
}

/** One button an option, each by its name. */
function options(s: Scribe, parts: readonly Part[]): Live {
  const buttons = parts.map((part, index) =>
    textButton(nameOf(s, part), 'option', () => s.session.act((run) => run.choose(index))),
  );
  return { element: el('div', { class: 'options' }, ...buttons), update: () => {} };
}

/** Says so where the hand is on another muscle than the one asked for. */
function otherMuscle(s: Scribe, wanted: string, key: 'learn.on_other' | 'learn.holds_other'): Live {
  return paragraph('quiet small', () => {
    const { part, line } = s.app.touch;
    const other = key === 'learn.on_other' ? part : line;
    return other !== null && other !== wanted ? s.t(key, s.session.nameOf(other)) : '';
  });
}

function typedName(s: Scribe): Live {
  const input = el('input', { type: 'text', maxlength: '100', autocomplete: 'off', spellcheck: 'false' });
  const answer = () => {
    if (input.value.trim() !== '') s.session.act((run) => run.type(input.value));
  };
  input.addEventListener('keydown', (event) => {
    if (event.key === 'Enter') answer();
  });
  const label = el('label', {}, s.t('learn.typed'), input);
  const element = el('div', { class: 'typed' }, label, textButton(s.t('learn.answer'), 'primary', answer));
  return { element, update: () => {} };
}

function touchView(s: Scribe, task: TaskOf<'touch'>): Live[] {
  const wanted = keyOf(s.session.anatomy, task.part);
  return [paragraph('', () => s.t('web.learn.touch')), otherMuscle(s, wanted, 'learn.on_other')];
}

function pressView(s: Scribe, task: TaskOf<'press'>): Live[] {
  const { low_N, high_N, muscle, hold_s } = task;
  const wanted = keyOf(s.session.anatomy, { kind: 'muscle', index: muscle });
  const where = (force_N: number) => {
    if (force_N < low_N) return 'learn.press.more';
    return force_N > high_N ? 'learn.press.less' : 'learn.press.good';
  };
  return [
    paragraph('', () => s.t('web.learn.press', muscleName(s, muscle))),
    bandBar(task, () => s.state.force_N),
    paragraph('', () => s.t('learn.press.force', s.state.force_N, low_N, high_N, s.t(where(s.state.force_N)))),
    timeHeld(s, hold_s),
    otherMuscle(s, wanted, 'learn.on_other'),
  ];
}

function explanation(s: Scribe, task: TaskOf<'predict'>): Live {
  const arm_mm = 1000 * s.state.moment_arm_m;
  const key = arm_mm > 0 ? 'learn.predict.flexes' : 'learn.predict.extends';
  return paragraph('', () => s.t(key, muscleName(s, task.muscle), Math.abs(arm_mm), jointName(s, task.joint)));
}

function predictView(s: Scribe, task: TaskOf<'predict'>): Live[] {
  const { state } = s;
  if (!state.predicted) {
    const motion = (kind: Motion) =>
      textButton(s.t(`learn.${kind}`), 'option', () => s.session.act((run) => run.predict(kind)));
    const element = el('div', { class: 'options' }, motion('flexion'), motion('extension'));
    const question = () => s.t('learn.predict', muscleName(s, task.muscle), jointName(s, task.joint));
    return [paragraph('', question), { element, update: () => {} }];
  }
  const said = paragraph('', () => s.t('learn.predicted', s.t(`learn.${state.predicted ?? 'flexion'}`)));
  if (state.done) return [said, explanation(s, task)];
  const wanted = keyOf(s.session.anatomy, { kind: 'muscle', index: task.muscle });
  const turned = () => ({
    share: Math.abs(state.turned_rad) / task.turn_rad,
    text: s.t('learn.turned', DEGREES * state.turned_rad),
  });
  const pull = paragraph('', () => s.t('web.learn.pull', muscleName(s, task.muscle)));
  return [said, pull, shareBar(turned), otherMuscle(s, wanted, 'learn.holds_other')];
}

/** The slider is the teacher's; a student watches what it does. */
function coContraction(s: Scribe): Live {
  if (s.app.me.role !== 'instructor') return paragraph('quiet small', () => s.t('web.learn.stiffen_student'));
  const slider = el('input', { type: 'range', min: '0', max: '1', step: '0.01' });
  slider.value = String(s.app.inForce?.common ?? 0);
  slider.addEventListener('input', () =>
    s.app.send({ do: 'co_contract', common: Number(slider.value), difference: 0 }),
  );
  return { element: el('label', { class: 'slider' }, s.t('learn.common'), slider), update: () => {} };
}

function stiffenView(s: Scribe, task: TaskOf<'stiffen'>): Live[] {
  const { state } = s;
  const stiffness = () => {
    const wanted = task.factor * state.lowest_Nm_rad;
    if (wanted <= 0) return { share: 0, text: '' }; // it has not come to rest yet
    return { share: state.stiffness_Nm_rad / wanted, text: s.t('learn.stiffness', state.stiffness_Nm_rad, wanted) };
  };
  const angle = () => {
    const turned_rad = Math.abs(state.turned_rad);
    const key = turned_rad > task.within_rad ? 'learn.strayed' : 'learn.stays';
    return s.t(key, DEGREES * turned_rad, DEGREES * task.within_rad);
  };
  return [coContraction(s), shareBar(stiffness), paragraph('', angle), timeHeld(s, task.hold_s)];
}

function identifyView(s: Scribe, task: TaskOf<'identify'>): Live[] {
  const found = () => {
    if (!s.state.touched) return s.t('web.learn.identify');
    return s.t(s.state.held_s > 0 ? 'learn.identify.found' : 'learn.identify.left');
  };
  return [paragraph('', found), options(s, task.options)];
}

function needsHand(task: Task): boolean {
  return ['touch', 'press', 'predict', 'identify'].includes(task.kind);
}

/** Nothing is left to do of a task that is done, but to read why. */
function viewsOf(s: Scribe, task: Task): Live[] {
  if (task.kind === 'predict') return predictView(s, task);
  if (s.state.done) return [];
  switch (task.kind) {
    case 'find':
      return [paragraph('', () => s.t('web.learn.find'))];
    case 'touch':
      return touchView(s, task);
    case 'name':
      return [task.options.length > 0 ? options(s, task.options) : typedName(s)];
    case 'press':
      return pressView(s, task);
    case 'stiffen':
      return stiffenView(s, task);
    case 'identify':
      return identifyView(s, task);
    case 'read':
      return [];
  }
}

function feedbackText({ session, state, t }: Scribe, task: Task): string {
  if (state.feedback === 'right') return t('learn.right');
  if (state.feedback === 'touchFirst') return t('learn.touch_first');
  if (state.feedback !== 'wrong') return '';
  if (task.kind === 'predict') return t('learn.wrong_prediction');
  const part = partOfKey(session.anatomy, state.answer);
  return part ? t('learn.wrong_part', session.nameOf(state.answer)) : t('learn.wrong');
}

export function taskViews(app: App, session: LessonSession): Live[] {
  const { state, step } = session.run;
  const scribe: Scribe = { app, session, state, t: (key, ...values) => app.texts.t(key, ...values) };
  const views = viewsOf(scribe, step.task);
  if (needsHand(step.task) && app.me.hand < 0 && !state.done) {
    views.push(paragraph('quiet small', () => scribe.t('web.learn.no_hand')));
  }
  const feedback = paragraph(`feedback ${state.feedback}`, () => feedbackText(scribe, step.task));
  feedback.element.setAttribute('role', 'status');
  return [...views, feedback];
}
