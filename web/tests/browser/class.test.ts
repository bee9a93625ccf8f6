import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { ClassPages, PHONE } from './class_page';

let pages: ClassPages;
let teacher: Page;
let student: Page;
let phone: Page;

before(async () => {
  pages = await ClassPages.open();
  teacher = await pages.join('Teacher', 'instructor');
  student = await pages.join('=Zoë <b>', 'student');
  phone = await pages.join('Phone', 'student', { ...PHONE, locale: 'de-DE' });
});

after(async () => {
  await pages.close();
  assert.deepEqual(pages.errors, []);
});

const pressed = (page: Page, selector: string) => page.waitForSelector(`${selector}[aria-pressed="true"]`);

test('a raised hand is seen by the teacher, markup in a name as it was typed', async () => {
  await student.click('text=Hand up');
  await teacher.waitForSelector('.members .up >> text=hand up');
  assert.equal(await teacher.innerText('.members .up .name'), '=Zoë <b>');
  await student.click('text=Hand down');
  await teacher.waitForSelector('.members .up', { state: 'detached' });
});

test('all look where the teacher does, until one looks freely', async () => {
  await teacher.click('text=All look here');
  await teacher.selectOption('.choice', 'kind');
  await teacher.click('.part:text-is("Brachialis")');
  await student.waitForSelector('.card h3:text-is("Brachialis")');
  await student.waitForSelector('.legend:has-text("flexor")');
  await student.click('text=Look freely');
  assert.equal(await student.$eval('.choice', (choice) => (choice as HTMLSelectElement).value), 'own');
  await student.click('text=Back to the teacher');
  await student.waitForSelector('.legend:has-text("flexor")');
  await teacher.click('text=Let them look freely');
  await student.waitForSelector('.banner', { state: 'detached' });
});

test('a frozen class says so', async () => {
  await teacher.click('.class >> text=Freeze');
  await student.waitForSelector('.banner:has-text("frozen")');
  await teacher.click('text=Let them touch again');
  await student.waitForSelector('.banner', { state: 'detached' });
});

test('a question is asked, answered, changed, counted and closed', async () => {
  await teacher.click('button:text-is("Ask a question")');
  await teacher.fill('dialog textarea', 'Which <i>one</i>?');
  const options = await teacher.$$('.option-list input');
  for (const [i, text] of ['first', 'second', 'second'].entries()) await options[i]?.fill(text);
  await teacher.click('text=Ask the class');
  await student.click('.answer:text-is("first")');
  await student.click('.answer:text-is("second")');
  await pressed(student, '.answer:text-is("second")');
  await phone.tap('.answer:text-is("first")');
  await phone.waitForSelector('.question:has-text("Ihre Antwort: first")');
  await teacher.waitForSelector('.counts:has-text("2 of 2 students")');
  assert.equal(await student.innerText('.question h2'), 'Which <i>one</i>?');
  const counts = await teacher.$$eval('.bars .share-text', (bars) => bars.map((bar) => bar.textContent));
  assert.deepEqual(counts, ['first: 1', 'second: 1']);
  await teacher.click('text=Close the question');
  await student.waitForSelector('.question', { state: 'detached' });
});

test('same picture, different feel: by key, by preset, by slider', async () => {
  await teacher.keyboard.press('b');
  await pressed(teacher, '.feel:has-text("B")');
  assert.equal(pages.server.world.common, 1);
  await teacher.keyboard.press('a');
  await pressed(teacher, '.feel:has-text("A")');
  await teacher.click('.bench >> text=Light');
  await teacher.waitForFunction(() => document.querySelector<HTMLInputElement>('.bench input')?.value === '0.25');
  await teacher.click('text=Keep as A');
  assert.match(await teacher.innerText('.feel >> nth=0'), /25 %/);
  await teacher.focus('.bench input');
  await teacher.keyboard.press('End');
  await teacher.waitForFunction(() => document.querySelector('.stiffness .big-number')?.textContent?.includes('8.00'));
  await teacher.keyboard.press('a'); // from the slider, too
  await pressed(teacher, '.feel:has-text("A")');
  await teacher.click('.bench >> text=gravity');
  await pressed(teacher, '.bench .toggle:text-is("gravity")');
  assert.equal(pages.server.world.gravity, true);
});

test('a lesson is opened for all, and its results come as a table and as a file', async () => {
  await teacher.selectOption('.class select', '1_find_and_touch');
  await phone.waitForSelector('.learn h3:has-text("Where you are")');
  await student.click('.step-buttons >> text=Next');
  await student.click('.step-buttons >> text=Hint');
  await student.click('.step-buttons >> text=Leave out');
  await teacher.click('#panel-results > summary');
  await teacher.waitForSelector('.results td:text-is("0 of 1")');
  const [download] = await Promise.all([teacher.waitForEvent('download'), teacher.click('text=Save table (CSV)')]);
  const csv = readFileSync(await download.path(), 'utf8');
  assert.match(csv, /^\uFEFFclient,name,lesson,step,answer,points,of,question\r\n/);
  assert.match(csv, /\d+,'=Zoë <b>,1_find_and_touch,2,,0,1,\r\n/);
  assert.match(csv, /\d+,'=Zoë <b>,question,0,second,0,0,Which <i>one<\/i>\?\r\n/);
  await teacher.selectOption('.class select', '');
});

test('a broken lesson is named with what is wrong, its markup as text', async () => {
  await student.click('.step-buttons >> text=End');
  assert.match(await student.innerText('.lesson.broken'), /Broken <b>lesson<\/b>[\s\S]*"key" is missing/);
});

test('the link for students stands beside its code; one of this computer alone is warned of', async () => {
  await teacher.click('text=Invite students');
  assert.match(await teacher.inputValue('.invite input'), /^http:\/\/192\.0\.2\.7:7481\/#token=(0f){16}$/);
  await teacher.waitForSelector('.invite svg[role="img"] path');
  await teacher.waitForSelector('.invite .warning', { state: 'hidden' });
  await teacher.fill('.invite input', 'http://127.0.0.1:7481/');
  await teacher.waitForSelector('.invite .warning:has-text("this computer only")');
  await teacher.fill('.invite input', 'no link');
  await teacher.waitForSelector('.invite svg', { state: 'detached' });
  await teacher.click('.invite >> text=Close');
});

test('another language is shown at once, everywhere', async () => {
  await student.selectOption('select[aria-label="language"]', 'de');
  await student.waitForSelector('.bar-tools >> text=Melden');
  await student.waitForSelector('.panel-title:text-is("Lernen")');
  await student.waitForSelector('.lesson >> text=Beginnen >> nth=0');
  await student.waitForSelector('summary:has-text("Knochen")');
  assert.equal(await student.getAttribute('html', 'lang'), 'de');
  await student.selectOption('select[aria-label="Sprache"]', 'en');
  await student.waitForSelector('.panel-title:text-is("Learn")');
});

test('after a break the class goes on, a raised hand and an answer are told again', async () => {
  await student.click('text=Hand up');
  await teacher.waitForSelector('.members .up');
  await teacher.click('button:text-is("Ask a question")');
  await teacher.click('text=Ask the class');
  await student.click('.answer:text-is("first")');
  await teacher.waitForSelector('.counts:has-text("1 of 2 students")');
  const told = () => pages.server.heard.filter(({ do: wish }) => wish === 'class_hand_up' || wish === 'class_answer');
  const before = told().length;
  pages.server.drop();
  await student.waitForSelector('.status-link[data-state="broken"]');
  await student.waitForSelector('.status-link[data-state="joined"]');
  await teacher.waitForSelector('.status-link[data-state="joined"]', { state: 'attached' });
  await teacher.waitForSelector('.members .up');
  await teacher.waitForSelector('.counts:has-text("first: 1")');
  assert.equal(told().length, before + 2);
  await teacher.click('text=Close the question');
  await student.click('text=Hand down');
  await teacher.waitForSelector('.members .up', { state: 'detached' });
});

test('a browser without WebGL 2 is told so in its language', async () => {
  const page = await pages.page({ locale: 'de-DE' });
  await page.addInitScript(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await page.goto(pages.url);
  await page.waitForSelector('.fatal:has-text("WebGL 2 ist aus")');
});

test('a look that a page before has begun is ended; an end during a break is told after it', async () => {
  await teacher.click('text=All look here');
  await student.waitForSelector('.banner:has-text("teacher looks")');
  await teacher.reload();
  await pressed(teacher, 'button:text-is("Let them look freely")');
  await teacher.click('text=Let them look freely');
  await student.waitForSelector('.banner', { state: 'detached' });
  await teacher.click('text=All look here');
  await student.waitForSelector('.banner:has-text("teacher looks")');
  pages.server.drop();
  await teacher.waitForSelector('.status-link[data-state="broken"]', { state: 'attached' });
  await teacher.click('text=Let them look freely');
  await teacher.waitForSelector('.class .toggle:text-is("All look here")');
  await student.waitForSelector('.banner', { state: 'detached' });
});

test('a page of another version than the server is now ends, and says that it must be loaded again', async () => {
  await phone.route('**/scene.json', (route) => route.fulfill({ json: { version: '9.9.9', name: 'elbow' } }));
  pages.server.drop();
  await phone.waitForSelector('.banner:has-text("Laden Sie diese Seite neu")');
  await teacher.waitForSelector('.status-link[data-state="joined"]', { state: 'attached' });
  await phone.waitForSelector('.status-link[data-state="ended"]', { state: 'attached' });
  await teacher.waitForSelector('.class p:has-text("Students: 1.")');
});
