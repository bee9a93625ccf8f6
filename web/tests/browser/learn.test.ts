import assert from 'node:assert/strict';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { ClassPages } from './class_page';

const GRID_PX = 12;

let pages: ClassPages;
let student: Page;
let teacher: Page;

before(async () => {
  pages = await ClassPages.open();
  teacher = await pages.join('Teacher', 'instructor');
  student = await pages.join('Student', 'student');
  await student.click('.lesson:has-text("Hands on") >> text=Start');
});

after(async () => {
  await pages.close();
  assert.deepEqual(pages.errors, []);
});

/** A place of the picture where a part is: the pointer says so. */
async function place(): Promise<{ x: number; y: number }> {
  const box = await student.locator('.limb-canvas').boundingBox();
  assert.ok(box);
  const middle = { x: box.x + box.width / 2, y: box.y + box.height / 2 };
  for (let ring = 0; ring * GRID_PX < box.height / 2; ++ring) {
    for (let step = 0; step < Math.max(1, 8 * ring); ++step) {
      const angle = (2 * Math.PI * step) / Math.max(1, 8 * ring);
      const [x, y] = [middle.x + ring * GRID_PX * Math.cos(angle), middle.y + ring * GRID_PX * Math.sin(angle)];
      await student.mouse.move(x, y);
      const over = await student.$eval('.limb-canvas', (canvas) => (canvas as HTMLElement).dataset['over'] ?? '');
      if (over !== '') return { x, y };
    }
  }
  throw new Error('no part is under the pointer anywhere');
}

const right = () => student.waitForSelector('.feedback.right');
const title = (text: string) => student.waitForSelector(`.learn h3:text-is("${text}")`);
const next = () => student.click('.step-buttons >> text=Next');

test('find: a click on the limb; names are hidden until then', async () => {
  await title('find');
  await student.waitForTimeout(1500); // the view has turned
  assert.match(await student.innerText('.find'), /Names are hidden/);
  const { x, y } = await place();
  await student.mouse.click(x, y);
  await right();
  await student.waitForSelector('.part:text-is("Brachialis")');
  await next();
});

test('touch and press: by the pointer held on it', async () => {
  for (const kind of ['touch', 'press']) {
    await title(kind);
    const { x, y } = await place();
    await student.mouse.move(x, y);
    await student.mouse.down();
    await right();
    await student.mouse.up();
    await next();
  }
});

test('name: typed, a wrong one takes half, a slip is forgiven', async () => {
  await title('name');
  await student.fill('.typed input', 'biceps');
  await student.click('.typed >> text=Answer');
  await student.waitForSelector('.feedback.wrong');
  await student.fill('.typed input', 'm. brachalis');
  await student.keyboard.press('Enter');
  await right();
  await next();
});

test('identify: touched first, then named', async () => {
  await title('identify');
  await student.click('.option:text-is("Brachialis")');
  await student.waitForSelector('.feedback:has-text("Touch it first")');
  const { x, y } = await place();
  await student.mouse.move(x, y);
  await student.mouse.down();
  await student.waitForSelector('.step:has-text("You are on it. Which")');
  await student.mouse.up();
  await student.click('.option:text-is("Brachialis")');
  await right();
  await next();
});

test('predict: said first, then seen by the pull', async () => {
  await title('predict');
  await student.click('.option:text-is("Flexion")');
  const { x, y } = await place();
  await student.mouse.move(x, y);
  await student.mouse.down();
  for (let way = 0; way <= 120; way += 10) await student.mouse.move(x + way, y);
  await right();
  await student.mouse.up();
  await student.waitForSelector('.step:has-text("its pull flexes the joint")');
  await next();
});

test('stiffen: the teacher sets it, the student sees it', async () => {
  await title('stiffen');
  await student.waitForSelector('.step:has-text("K = 2.00 of 4.00")');
  await teacher.keyboard.press('b');
  await right();
  await next();
});

test('the end says what was earned, and the teacher has every step', async () => {
  await student.waitForSelector('.sum:text-is("Finished: 6.5 of 7 points.")');
  await teacher.click('#panel-results > summary');
  await teacher.waitForSelector('.results td:text-is("6.5 of 7")');
  await student.click('.step-buttons >> text=End');
  await student.waitForSelector('.part:text-is("Biceps brachii")');
});
