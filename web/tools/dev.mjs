// Serves dist/ as it is now, and passes all else on to a running `myotact serve --web`, which keeps the page that it
// found when it started: node tools/dev.mjs [PORT of this page] [PORT of that server].
import { createServer, request as ask } from 'node:http';
import { connect } from 'node:net';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const repository = fileURLToPath(new URL('../../', import.meta.url));
const dist = join(repository, 'web/dist');
const [page = '7500', upstream = '7481'] = process.argv.slice(2);
const types = { '.html': 'text/html', '.js': 'text/javascript', '.css': 'text/css', '.txt': 'text/plain' };

/** As the server sends it. */
function policy(host) {
  const connections = `connect-src 'self' ws://${host}`;
  const sources = `default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' data: blob:; ${connections}`;
  return `${sources}; base-uri 'none'; form-action 'none'; frame-ancestors 'none'`;
}

function languageTexts(code) {
  const folder = join(repository, 'assets/languages', code);
  const files = readdirSync(folder).map((name) => JSON.parse(readFileSync(join(folder, name), 'utf8')));
  return JSON.stringify(Object.assign({}, ...files));
}

function passOn(request, response) {
  const there = ask({ port: upstream, path: request.url, headers: request.headers }, (answer) => {
    response.writeHead(answer.statusCode, answer.headers);
    answer.pipe(response);
  });
  there.on('error', () => response.writeHead(502).end());
  request.pipe(there);
}

const server = createServer((request, response) => {
  const path = new URL(request.url, 'http://localhost').pathname;
  const file = join(dist, path === '/' ? 'index.html' : path);
  const code = /^\/languages\/([a-z]+)\.json$/.exec(path)?.[1];
  if (code !== undefined) return response.end(languageTexts(code));
  if (!file.startsWith(dist) || !existsSync(file)) return passOn(request, response);
  const headers = { 'content-type': `${types[extname(file)]}; charset=utf-8` };
  response.writeHead(200, { ...headers, 'content-security-policy': policy(request.headers.host) });
  response.end(readFileSync(file));
});
server.on('upgrade', (request, client, head) => {
  const there = connect(Number(upstream), '127.0.0.1', () => {
    const pairs = request.rawHeaders.map((text, i) => (i % 2 === 0 ? `${text}: ` : `${text}\r\n`));
    there.write(`GET ${request.url} HTTP/1.1\r\n${pairs.join('')}\r\n`);
    there.write(head);
    there.pipe(client).pipe(there);
  });
  there.on('error', () => client.destroy());
  client.on('error', () => there.destroy());
});
server.listen(Number(page), '127.0.0.1', () => console.log(`http://127.0.0.1:${page}`));
