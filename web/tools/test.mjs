// Bundles the tests into a folder that is thrown away and runs them with node's own runner.
import { build } from 'esbuild';
import { spawnSync } from 'node:child_process';
import { mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const tests = fileURLToPath(new URL('../tests/', import.meta.url));
const wanted = process.argv[2] ?? '';
const names = readdirSync(tests).filter((name) => name.endsWith('.test.ts') && name.includes(wanted));
const folder = mkdtempSync(join(tmpdir(), 'myotact-web-'));
try {
  await build({
    entryPoints: names.map((name) => join(tests, name)),
    outdir: folder,
    outExtension: { '.js': '.mjs' },
    bundle: true,
    platform: 'node',
    format: 'esm',
    target: 'node18',
    define: { 'process.env.MYOTACT_REPOSITORY': JSON.stringify(fileURLToPath(new URL('../../', import.meta.url))) },
  });
  const files = readdirSync(folder).map((name) => join(folder, name));
  process.exitCode = spawnSync(process.execPath, ['--test', ...files], { stdio: 'inherit' }).status ?? 1;
} finally {
  rmSync(folder, { recursive: true, force: true });
}
