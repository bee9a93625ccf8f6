// Writes the licences of the packages that the bundle is made of, as esbuild's metafile names them.
import { readdir, readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { fileURLToPath } from 'node:url';

const web = fileURLToPath(new URL('..', import.meta.url));
const LICENCE_FILE = /^(licen[cs]e|copying|notice)(\.(md|txt))?$/i;

/** Folders of packages, each once: "node_modules/three", "node_modules/@scope/name". */
function packagesOf(metafile) {
  const used = Object.values(metafile.outputs).flatMap((output) => Object.keys(output.inputs));
  const folders = used.map((file) => /^(.*node_modules\/(?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1]);
  return [...new Set(folders.filter(Boolean))].sort();
}

async function textsOf(folder) {
  const files = (await readdir(folder)).filter((file) => LICENCE_FILE.test(file)).sort();
  return Promise.all(files.map((file) => readFile(join(folder, file), 'utf8')));
}

/** Some packages name their licence only at the head of their source: that comment then is it. */
async function headComment(folder, { module, main }) {
  const source = await readFile(join(folder, module ?? main ?? 'index.js'), 'utf8');
  return /^(?:\s*\/\/[^\n]*\n|\s*\/\*[\s\S]*?\*\/)+/.exec(source)?.[0]?.trim() ?? '';
}

async function entryOf(path) {
  const folder = join(web, path);
  const about = JSON.parse(await readFile(join(folder, 'package.json'), 'utf8'));
  const texts = await textsOf(folder);
  if (texts.length === 0) texts.push(await headComment(folder, about));
  if (!about.license || texts.every((text) => text === ''))
    throw new Error(`${path}: no licence is found; add its text`);
  return `${about.name} ${about.version}, ${about.license}\n\n${texts.map((text) => text.trim()).join('\n\n')}\n`;
}

export async function writeLicences(metafile, file) {
  const entries = await Promise.all(packagesOf(metafile).map(entryOf));
  await writeFile(file, entries.join(`\n${'-'.repeat(80)}\n\n`));
}
