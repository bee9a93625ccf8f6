/** One file that plays a recording without a server: the page with its style, script and the frames inside. */

import { LICENCES_ID, toElement } from '../app/licences';
import { RECORDING_ID } from './recording';

/** What the exported page may do: nothing but run what it holds. */
const POLICY =
  "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; " +
  "form-action 'none'";

/** What would end a <script> or <style>, as texts of scripts may hold it, in letters that mean the same. */
function inElement(text: string): string {
  return text.replace(/<\/(?=script|style)/gi, '<\\/');
}

function replaceOnce(page: string, pattern: RegExp, replacement: string): string {
  if (!pattern.test(page)) throw new Error(`the page has no ${pattern.source}`);
  return page.replace(pattern, () => replacement);
}

/** What goes into the page; `recording` is recordingText(). */
export interface Inlay {
  style: string;
  script: string;
  licences: string;
  recording: string;
}

/** `page` names its style and script by one <link rel="stylesheet"> and one <script src>. */
export function inlinePage(page: string, { style, script, licences, recording }: Inlay): string {
  const data =
    `<script type="text/plain" id="${LICENCES_ID}">${toElement(licences)}</script>` +
    `<script type="application/json" id="${RECORDING_ID}">${recording}</script>`;
  const policy = `<meta http-equiv="Content-Security-Policy" content="${POLICY}">`;
  let whole = replaceOnce(page, /<link\b[^>]*\brel="?stylesheet"?[^>]*>/i, `<style>${inElement(style)}</style>`);
  whole = replaceOnce(whole, /<script\b[^>]*\bsrc=[^>]*>\s*<\/script>/i, '');
  whole = replaceOnce(whole, /<meta\b[^>]*charset[^>]*>/i, `<meta charset="utf-8">${policy}`);
  return replaceOnce(whole, /<\/body>/i, `${data}<script type="module">${inElement(script)}</script></body>`);
}
