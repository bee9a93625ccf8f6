// Makes dist/: the page, its script, its style and the licences of what it is made of.
import { build } from 'esbuild';
import { cp, mkdir, readFile, rm, stat } from 'node:fs/promises';
import { existsSync } from 'node:fs';
import { gzipSync } from 'node:zlib';
import { fileURLToPath } from 'node:url';

const here = fileURLToPath(new URL('.', import.meta.url));
const dist = process.argv[2] ?? `${here}dist`;
/** A class of 30 behind one access point loads the page in seconds. */
const MOST_GZIPPED_BYTES = 400_000;

await rm(dist, { recursive: true, force: true });
await mkdir(dist, { recursive: true });
const { metafile } = await build({
  absWorkingDir: here,
  entryPoints: [
    { in: 'src/app/main.ts', out: 'app' },
    { in: 'src/app.css', out: 'app' },
  ],
  outdir: dist,
  bundle: true,
  minify: true,
  format: 'esm',
  target: 'es2022',
  legalComments: 'none',
  metafile: true,
});
await cp(`${here}index.html`, `${dist}/index.html`);
if (existsSync(`${here}tools/licences.mjs`)) {
  const { writeLicences } = await import('./tools/licences.mjs');
  await writeLicences(metafile, `${dist}/licences.txt`);
}

const script = await readFile(`${dist}/app.js`);
const size_bytes = gzipSync(script).length;
const style_bytes = (await stat(`${dist}/app.css`)).size;
console.log(`app.js ${script.length} bytes, ${size_bytes} gzipped; app.css ${style_bytes} bytes`);
if (size_bytes > MOST_GZIPPED_BYTES) {
  console.error(`app.js must be at most ${MOST_GZIPPED_BYTES} bytes gzipped`);
  process.exitCode = 1;
}
