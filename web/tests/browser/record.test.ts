import assert from 'node:assert/strict';
import { readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { ClassPages } from './class_page';

const RECORDED_MS = 3500;
const file = join(tmpdir(), `myotact-recording-${process.pid}.html`);
let pages: ClassPages;

before(async () => {
  pages = await ClassPages.open();
});

after(async () => {
  rmSync(file, { force: true });
  await pages.close();
  assert.deepEqual(pages.errors, []);
});

test("a recording is saved as one file without anybody's name", async () => {
  const teacher = await pages.join('Teacher Somebody', 'instructor');
  await teacher.click('#panel-record > summary');
  await teacher.click('.record .primary');
  await teacher.waitForTimeout(RECORDED_MS / 2);
  await teacher.keyboard.press('b');
  await teacher.waitForTimeout(RECORDED_MS / 2);
  await teacher.click('.record .primary');
  const [download] = await Promise.all([teacher.waitForEvent('download'), teacher.click('text=Save as a file')]);
  const page = readFileSync(await download.path(), 'utf8');
  assert.match(download.suggestedFilename(), /^myotact-elbow-[0-9_-]+\.html$/);
  assert.ok(!page.includes('Somebody'));
  writeFileSync(file, page);
});

test('the file plays by itself, without a server, to any moment', async () => {
  const page = await pages.page({ locale: 'de-DE' });
  const asked: string[] = [];
  page.on('request', (request) => asked.push(request.url().slice(0, 5)));
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector('.time-bar >> text=Abspielen'); // it has come to its end
  const stiffness = (value: string) =>
    page.waitForFunction(
      (wanted) => document.querySelector('.stiffness .big-number')?.textContent?.includes(wanted),
      value,
    );
  await stiffness('8.00');
  const seek = (time_s: string) => page.fill('.time-bar input', time_s);
  await seek('0.5');
  await stiffness('2.00');
  assert.match(await page.innerText('.time'), /^0:00/);
  await seek('3');
  await stiffness('8.00');
  await page.click('.status-line >> text=Lizenzen');
  assert.match(await page.innerText('dialog .licences'), /three 0\.\d+[\s\S]*Copyright/);
  await page.click('dialog >> text=Schließen');
  await page.click('.part:text-is("Brachialis")');
  await page.waitForSelector('.card .now:has-text("100 %")');
  assert.deepEqual(
    [...new Set(asked)].filter((scheme) => !['file:', 'data:', 'blob:'].includes(scheme)),
    [],
  );
});
