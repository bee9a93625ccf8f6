// Builds the page into a folder that is thrown away and tests it in a browser against a class without a simulation:
// node tools/browser.mjs [part of a test file's name]. CHROMIUM names the browser where it is not /usr/bin/chromium.
import { build } from 'esbuild';
import { spawnSync } from 'node:child_process';
import { existsSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = fileURLToPath(new URL('..', import.meta.url));
const tests = join(web, 'tests/browser');
const chromium = process.env.CHROMIUM ?? '/usr/bin/chromium';
if (!existsSync(chromium))
  throw new Error(`there is no browser at ${chromium}; install chromium, or name one by CHROMIUM`);
// Within the package, so that the tests find its modules.
const folder = mkdtempSync(join(web, 'node_modules/.browser-'));
const page = mkdtempSync(join(tmpdir(), 'myotact-page-'));

function run(...words) {
  return spawnSync(process.execPath, words, {
    stdio: 'inherit',
    env: { ...process.env, CHROMIUM: chromium, MYOTACT_PAGE: page },
  });
}

try {
  if (run(join(web, 'build.mjs'), page).status !== 0) throw new Error('the page cannot be built');
  const names = readdirSync(tests).filter((name) => name.endsWith('.test.ts') && name.includes(process.argv[2] ?? ''));
  await build({
    entryPoints: names.map((name) => join(tests, name)),
    outdir: folder,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    external: ['playwright-core'],
    define: { 'process.env.MYOTACT_REPOSITORY': JSON.stringify(join(web, '..')) },
  });
  process.exitCode =
    run('--test', '--test-concurrency=1', ...names.map((name) => join(folder, name.replace('.ts', '.mjs')))).status ??
    1;
} finally {
  rmSync(folder, { recursive: true, force: true });
  rmSync(page, { recursive: true, force: true });
}
