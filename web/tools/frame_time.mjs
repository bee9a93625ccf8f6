// How long a frame of the turning limb takes at 1280x720 without a graphics card: script and drawing, finished; and
// how often the browser shows one. node tools/frame_time.mjs [ADDRESS], with `myotact serve --web` running there.
import { chromium } from 'playwright-core';

const address = process.argv[2] ?? 'http://127.0.0.1:7481/';
const SECONDS = 6;

/** In the page: waits for every drawn frame, and notes how long it took. */
function watchFrames() {
  window.frames_ms = [];
  window.shown_ms = [];
  let gl = null;
  const draw = WebGL2RenderingContext.prototype.drawElements;
  WebGL2RenderingContext.prototype.drawElements = function (...rest) {
    gl = this;
    return draw.apply(this, rest);
  };
  const request = window.requestAnimationFrame.bind(window);
  window.requestAnimationFrame = (callback) =>
    request((now_ms) => {
      gl = null;
      const begin_ms = performance.now();
      callback(now_ms);
      if (gl === null) return;
      gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
      window.frames_ms.push(performance.now() - begin_ms);
      window.shown_ms.push(now_ms);
    });
}

function percentiles(times) {
  const sorted = [...times].sort((a, b) => a - b);
  const at = (share) => sorted[Math.floor(share * (sorted.length - 1))].toFixed(1);
  return `p10 ${at(0.1)}  median ${at(0.5)}  p90 ${at(0.9)} ms`;
}

const browser = await chromium.launch({
  executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium',
  args: ['--no-sandbox', '--enable-unsafe-swiftshader', '--use-angle=swiftshader'],
});
const page = await browser.newPage({ viewport: { width: 1280, height: 720 } });
await page.addInitScript(watchFrames);
await page.goto(address);
await page.fill('#join-name', 'Frame time');
const joined_ms = Date.now();
await page.click('.join .primary');
await page.waitForFunction(() => window.frames_ms.length > 0);
console.log(`first picture after ${Date.now() - joined_ms} ms`);
await page.waitForTimeout(2000);
await page.evaluate(() => (window.frames_ms.length = window.shown_ms.length = 0));
await page.mouse.move(640, 360);
await page.mouse.down();
for (let i = 0, end_ms = Date.now() + 1000 * SECONDS; Date.now() < end_ms; ++i) {
  await page.mouse.move(640 + 100 * Math.sin(i / 10), 360);
  await page.waitForTimeout(16);
}
const { frames, shown } = await page.evaluate(() => ({ frames: window.frames_ms, shown: window.shown_ms }));
console.log(`frame      ${percentiles(frames)}`);
console.log(`one shown  ${percentiles(shown.slice(1).map((time_ms, i) => time_ms - shown[i]))} after another`);
await browser.close();
