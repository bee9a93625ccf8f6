/**
 * The page with a limb behind it: `myotact serve elbow --web`, with tokens, in a real browser. MYOTACT names the program,
 * which serves the page that was built last; without it these tests are left out.
 */
import assert from 'node:assert/strict';
import { spawn, type ChildProcess } from 'node:child_process';
import { once } from 'node:events';
import { createInterface } from 'node:readline';
import { after, before, test } from 'node:test';
import type { Page } from 'playwright-core';
import { ClassPages, PHONE } from './class_page';

const PROGRAM = process.env['MYOTACT'];
const skip = PROGRAM === undefined ? 'MYOTACT does not name the program' : false;
const [STUDENTS, TEACHERS] = ['00112233445566778899aabbccddeeff', 'ffeeddccbbaa99887766554433221100'];
/** A machine that draws by software and simulates beside that. */
const SLOW_MS = 60_000;

class Served {
  readonly links = new Map<string, string>();
  private constructor(private readonly process: ChildProcess) {}

  /** On the ports of one that ran before, or on free ones. */
  static async start(ports = ['0', '0']): Promise<Served> {
    const words = ['serve', 'elbow', '--web', '--hands', '3', '--log-level', 'warn'];
    const child = spawn(PROGRAM ?? '', [...words, '--port', ports[0]!, '--websocket-port', ports[1]!], {
      env: { ...process.env, MYOTACT_TOKEN: STUDENTS, MYOTACT_INSTRUCTOR_TOKEN: TEACHERS },
      stdio: ['ignore', 'pipe', 'inherit'],
    });
    const served = new Served(child);
    for await (const line of createInterface({ input: child.stdout! })) {
      const [name, text] = line.split(' ');
      if (name !== undefined && text !== undefined) served.links.set(name, text);
      if (name === 'instructor_page') break;
    }
    return served;
  }

  link(name: string): string {
    return this.links.get(name) ?? assert.fail(`the server printed no ${name}`);
  }
  ports(): string[] {
    return ['tcp', 'websocket'].map((name) => this.link(name).split(':').pop()!);
  }
  async stop(): Promise<void> {
    if (this.process.exitCode !== null) return;
    this.process.kill('SIGTERM');
    await once(this.process, 'exit');
  }
}

let served: Served;
let pages: ClassPages;
let student: Page;

async function join(link: string, name: string, options = {}): Promise<Page> {
  const page = await pages.page(options);
  page.setDefaultTimeout(SLOW_MS);
  await page.goto(link);
  await page.fill('#join-name', name);
  await page.click('.join .primary');
  await page.waitForSelector('.status-link[data-state="joined"]', { state: 'attached' });
  return page;
}

/** Holds the space bar, which repeats, until the hand holds something: a slow page may show no part at the first time. */
async function holdSpace(page: Page): Promise<void> {
  const holdsNothing = () => page.$eval('.felt-chip', (chip) => (chip as HTMLElement).hidden);
  for (let repeat = 0; repeat < 100 && (await holdsNothing()); ++repeat) {
    await page.keyboard.down('Space');
    await page.waitForTimeout(50);
  }
}

/** The force on the hand grows beyond this [N]. */
const felt = (page: Page, least_N: number) =>
  page.waitForFunction(
    (least) => Number(document.querySelector('.gauge-bar')?.getAttribute('aria-valuenow')) > least,
    least_N,
  );
const stiffness = (page: Page) =>
  page.$eval('.stiffness .big-number', (number) => Number(/-?[0-9.]+/.exec(number.textContent ?? '')?.[0]));

before(async () => {
  if (skip) return;
  served = await Served.start();
  pages = await ClassPages.open();
});

after(async () => {
  if (skip) return;
  await pages.close();
  await served.stop();
  // A socket that a server refuses or that it closes is the browser's complaint, not the page's.
  assert.deepEqual(
    pages.errors.filter((error) => !error.includes('WebSocket')),
    [],
  );
});

test('a link is all that it takes to see the limb, and its token leaves the address', { skip }, async () => {
  student = await join(served.link('page'), 'Student');
  assert.ok(!student.url().includes('token'), student.url());
  await student.waitForFunction(() => document.querySelector('.stiffness .big-number')?.textContent?.includes('K ='));
  const drawn = await student.screenshot({ clip: { x: 400, y: 100, width: 480, height: 560 } });
  assert.ok(drawn.length > 20_000, `a picture of ${drawn.length} bytes shows no limb`);
});

test('biceps is found with a slip of typing, pressed, and pushes back', { skip }, async () => {
  await student.fill('input[type="search"]', 'bicpes');
  await student.click('.part >> nth=0');
  assert.match(await student.innerText('.card h3'), /Biceps brachii/);
  await student.keyboard.press('Escape');
  await student.focus('canvas');
  await student.keyboard.press('t');
  await holdSpace(student);
  await felt(student, 0.1);
  await student.keyboard.up('Space');
});

test('its line is pulled', { skip }, async () => {
  await student.focus('canvas');
  await student.keyboard.press('p');
  await holdSpace(student);
  for (let step = 0; step < 12; ++step) await student.keyboard.press('ArrowUp');
  await felt(student, 0.3);
  await student.keyboard.up('Space');
});

test('the teacher stiffens the joint before all eyes and freezes the hands', { skip }, async () => {
  const teacher = await join(served.link('instructor_page'), 'Teacher');
  await teacher.click('text=At rest');
  await student.waitForTimeout(3000);
  const before_Nm_rad = await stiffness(student);
  await teacher.click('text=Firm');
  await student.waitForFunction(
    (least) =>
      Number(/-?[0-9.]+/.exec(document.querySelector('.stiffness .big-number')?.textContent ?? '')?.[0]) > least,
    1.5 * before_Nm_rad,
  );
  await teacher.click('.class >> text=Freeze');
  await student.waitForSelector('.banner:has-text("frozen")');
  await teacher.click('text=Let them touch again');
  await teacher.click('text=Invite students');
  assert.equal(await teacher.inputValue('dialog input'), served.link('page'));
  await teacher.close();
});

test('a phone joins by the same link', { skip }, async () => {
  const phone = await join(served.link('page'), 'Phone', PHONE);
  await phone.tap('text=Touch');
  await phone.close();
});

test('a wrong token is said in a sentence', { skip }, async () => {
  const page = await pages.page();
  await page.goto(served.link('page').replace(STUDENTS, TEACHERS.replace('ff', '00')));
  await page.fill('#join-name', 'Guest');
  await page.click('.join .primary');
  await page.waitForSelector('.banner:has-text("This link does not fit the class")');
  await page.close();
});

test('a class that ends says so, and goes on when it is back', { skip }, async () => {
  const ports = served.ports();
  await served.stop();
  await student.waitForSelector('.banner:has-text("has ended the class")');
  served = await Served.start(ports);
  await student.waitForSelector('.status-link[data-state="joined"]', { state: 'attached' });
  await student.waitForSelector('.banner', { state: 'detached' });
});
