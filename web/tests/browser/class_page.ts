/** Pages of a class in a real browser. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { chromium, type Browser, type BrowserContextOptions, type Page } from 'playwright-core';
import { REPOSITORY } from '../elbow';
import { FakeServer } from '../fake/server';

export const PHONE: BrowserContextOptions = { viewport: { width: 390, height: 844 }, hasTouch: true, isMobile: true };

/** One of each task for the hands, with little in the way. */
const HANDS_ON = {
  ...{ schema: 1, key: 'hands_on', title: 'Hands on', scene: 'elbow' },
  steps: [
    { kind: 'find', part: 'brachialis' },
    { kind: 'touch', part: 'brachialis' },
    { kind: 'press', muscle: 'brachialis', band_N: [0.05, 20], hold_s: 0.3 },
    { kind: 'name', part: 'brachialis' },
    { kind: 'identify', part: 'brachialis', options: ['biceps_brachii', 'brachialis'] },
    { kind: 'predict', muscle: 'brachialis', joint: 'elbow', motion: 'flexion' },
    { kind: 'stiffen', joint: 'elbow', factor: 2, hold_s: 0.3 },
  ].map((task) => ({
    title: task.kind,
    text: 'Do it.',
    task,
    view: 'cranial',
    show: { muscles: ['brachialis'], bones: [] },
  })),
};

/** Lessons of the elbow as they are shipped, one of each task, and one that is broken. */
function lessons(): unknown[] {
  const names = ['1_find_and_touch', '2_pull_a_line', '3_co_contraction'];
  const shipped = names.map((name) => readFileSync(join(REPOSITORY, 'assets/lessons', `${name}.json`), 'utf8'));
  return [...shipped.map((text): unknown => JSON.parse(text)), HANDS_ON, { schema: 1, title: 'Broken <b>lesson</b>' }];
}

export class ClassPages {
  readonly errors: string[] = [];

  private constructor(
    readonly server: FakeServer,
    readonly url: string,
    private readonly browser: Browser,
  ) {}

  static async open(): Promise<ClassPages> {
    const server = new FakeServer(process.env['MYOTACT_PAGE'] ?? '', lessons());
    const args = ['--no-sandbox', '--enable-unsafe-swiftshader', '--use-angle=swiftshader'];
    const browser = await chromium.launch({ executablePath: process.env['CHROMIUM'] ?? '/usr/bin/chromium', args });
    return new ClassPages(server, await server.listen(), browser);
  }

  /** `url`: of another page than the class's. */
  async page(options: BrowserContextOptions = {}): Promise<Page> {
    const context = await this.browser.newContext({
      viewport: { width: 1280, height: 720 },
      locale: 'en-US',
      ...options,
    });
    const page = await context.newPage();
    page.setDefaultTimeout(15000);
    page.on('pageerror', (error) => this.errors.push(error.message));
    page.on('console', (message) => {
      if (message.type() === 'error' && !message.text().includes('404')) this.errors.push(message.text());
    });
    return page;
  }

  async join(name: string, role: string, options: BrowserContextOptions = {}): Promise<Page> {
    const page = await this.page(options);
    await page.goto(`${this.url}#role=${role}`);
    await page.fill('#join-name', name);
    await page.click('.join .primary');
    await page.waitForSelector('.status-link[data-state="joined"]', { state: 'attached' });
    return page;
  }

  async close(): Promise<void> {
    await this.browser.close();
    this.server.close();
  }
}
