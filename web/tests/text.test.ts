import assert from 'node:assert/strict';
import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { format } from '../src/text/format';
import { createTexts, type Dictionary } from '../src/text/texts';
import { REPOSITORY } from './elbow';

const LANGUAGES = join(REPOSITORY, 'assets', 'languages');

function catalogue(language: string): Dictionary {
  const folder = join(LANGUAGES, language);
  const files = readdirSync(folder).filter((file) => file.endsWith('.json'));
  return Object.assign({}, ...files.map((file) => JSON.parse(readFileSync(join(folder, file), 'utf8')) as Dictionary));
}

function places(text: string): string[] {
  return text.match(/\{[^}]*\}/g) ?? [];
}

test('format fills places as the window does', () => {
  assert.equal(format('{} of {}', 'a', 3), 'a of 3');
  assert.equal(format('{:.2f} N, {:.0f} %', 1.239, 49.6), '1.24 N, 50 %');
  assert.equal(format('{:+.3f} and {:+.1f}', 0.5, -2), '+0.500 and -2.0');
  assert.equal(format('{:.2g} {:g}', 0.01234, 20), '0.012 20');
});

test('format leaves a text whose values are missing, and takes names for what they are', () => {
  assert.equal(format('{} of {}', 1), '{} of {}');
  assert.equal(format('called {}', '{:.2f} $& <b>'), 'called {:.2f} $& <b>');
  assert.equal(format('{:.2f}', 'text'), 'text');
});

test('texts fall back on English, then on the key', () => {
  const texts = createTexts({ en: { 'a.b': 'English {}', 'a.c': 'only here' }, de: { 'a.b': 'Deutsch {}' } }, 'en');
  const heard: string[] = [];
  texts.onChange((language) => heard.push(language));
  assert.equal(texts.t('a.b', 1), 'English 1');
  texts.choose('de');
  assert.deepEqual([texts.t('a.b', 1), texts.t('a.c'), texts.t('toString')], ['Deutsch 1', 'only here', 'toString']);
  texts.choose('xx');
  assert.deepEqual([texts.language, heard], ['de', ['de']]);
});

test('bound texts follow the language', () => {
  const texts = createTexts({ en: { a: 'one {}' }, de: { a: 'eins {}' } }, 'en');
  const attributes: Record<string, string> = {};
  const setAttribute = (name: string, value: string) => void (attributes[name] = value);
  const element = texts.bind({ textContent: '', setAttribute } as unknown as Element, 'a', 1);
  texts.bindAttribute(element, 'title', 'a', 2);
  assert.deepEqual([element.textContent, attributes], ['one 1', { title: 'one 2' }]);
  texts.choose('de');
  assert.deepEqual([element.textContent, attributes], ['eins 1', { title: 'eins 2' }]);
});

test('the languages have the same keys and places, and no key twice', () => {
  const english = catalogue('en');
  const german = catalogue('de');
  assert.deepEqual(Object.keys(german).sort(), Object.keys(english).sort());
  for (const [key, text] of Object.entries(english)) {
    assert.deepEqual(places(german[key] ?? ''), places(text), key);
    assert.equal(german[key] === '', text === '', key);
  }
  for (const language of ['en', 'de']) {
    const folder = join(LANGUAGES, language);
    const files = readdirSync(folder).map((file) => readFileSync(join(folder, file), 'utf8'));
    const keys = files.flatMap((file) => [...file.matchAll(/^\s*"([^"]+)":/gm)].map((match) => match[1]));
    assert.equal(new Set(keys).size, keys.length, `${language} has a key twice`);
  }
});

/** Every key that the sources name is there: a quoted word with a dot whose beginning is that of some key. */
test('the languages hold every key that the page names', () => {
  const english = catalogue('en');
  const beginnings = new Set(Object.keys(english).map((key) => key.split('.')[0]));
  const sources = readdirSync(join(REPOSITORY, 'web', 'src'), { recursive: true }) as string[];
  let named = 0;
  for (const file of sources.filter((name) => name.endsWith('.ts'))) {
    const source = readFileSync(join(REPOSITORY, 'web', 'src', file), 'utf8');
    for (const [, key] of source.matchAll(/'([a-z]+\.[a-zA-Z0-9_.]*[a-zA-Z0-9_])'/g)) {
      if (!key || !beginnings.has(key.split('.')[0])) continue;
      ++named;
      assert.ok(key in english, `${file} names ${key}`);
    }
  }
  assert.ok(named > 20);
});
