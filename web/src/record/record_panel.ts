/** Record and export: for instructors. */

import { button, el } from '../app/dom';
import { fetchShade } from '../app/shade';
import type { App } from '../app/state';
import type { Dictionary } from '../text/texts';
import { inlinePage } from './export_page';
import { LONGEST_S, Recorder } from './recorder';
import { recordingText } from './recording';
import { fileName, saveFile, timeStamp } from './save_file';

const EVERY_MS = 500; // the panel tells how long it is

async function textOf(path: string): Promise<string> {
  const answer = await fetch(path);
  if (!answer.ok) throw new Error(`${path}: ${answer.status}`);
  return answer.text();
}

/** The page as this server has it, with the recording inside. */
async function exportedPage(app: App, recorder: Recorder): Promise<string> {
  const load = async (language: string) => [language, JSON.parse(await textOf(`/languages/${language}.json`))] as const;
  const dictionaries = Object.fromEntries(await Promise.all(app.texts.languages.map(load))) as Record<
    string,
    Dictionary
  >;
  const files = ['/', '/app.css', '/app.js', '/licences.txt'];
  const [page = '', style = '', script = '', licences = ''] = await Promise.all(files.map(textOf));
  const shade = (await fetchShade()) ?? new Uint8Array();
  const recording = recordingText({ scene: app.scene, dictionaries, shade, frames: [...recorder.frames] });
  return inlinePage(page, { style, script, licences, recording });
}

export class RecordPanel {
  readonly element: HTMLElement;
  private readonly recorder = new Recorder();
  private readonly toggle = button('primary', () => this.startOrStop());
  private readonly save = button('plain', () => void this.export());
  private readonly status = el('p', { class: 'quiet small', role: 'status' });

  constructor(private readonly app: App) {
    const about = app.texts.bind(el('p', { class: 'quiet small' }), 'web.record.about', LONGEST_S);
    this.element = el(
      'div',
      { class: 'record' },
      about,
      el('div', { class: 'row wrap' }, this.toggle, this.save),
      this.status,
    );
    app.texts.bind(this.save, 'web.record.export');
    app.tapFrames((frame, at_ms) => {
      if (this.recorder.recording && !this.recorder.take(frame, at_ms, () => app.wholePicture())) this.full();
    });
    setInterval(() => this.recorder.recording && this.update(), EVERY_MS);
    app.on('language', () => this.update());
    this.update();
  }

  private startOrStop(): void {
    if (this.recorder.recording) this.recorder.stop();
    else this.start();
    this.update();
  }

  private start(): void {
    const { app } = this;
    const whole = app.wholePicture();
    this.recorder.start(whole ? [...app.primingFrames(), whole] : app.primingFrames(), performance.now());
  }

  private full(): void {
    this.app.toast(this.app.texts.t('web.record.full'));
    this.update();
  }

  private update(): void {
    const { recorder, app } = this;
    app.texts.bind(this.toggle, recorder.recording ? 'web.record.stop' : 'web.record.start');
    this.toggle.setAttribute('aria-pressed', String(recorder.recording));
    this.save.disabled = recorder.recording || recorder.frames.length === 0;
    this.element.classList.toggle('recording', recorder.recording);
    const key = recorder.recording ? 'web.record.runs' : 'web.record.holds';
    const has = recorder.recording || recorder.frames.length > 0;
    this.status.textContent = has ? app.texts.t(key, recorder.length_s, recorder.bytes / 1e6) : '';
  }

  private async export(): Promise<void> {
    const { app } = this;
    this.save.disabled = true;
    try {
      const page = await exportedPage(app, this.recorder);
      const name = fileName(`myotact-${app.scene.name}-${timeStamp()}`, '.html');
      saveFile(name, 'text/html', page);
      app.toast(app.texts.t('web.record.saved', name));
    } catch (failure) {
      app.toast(app.texts.t('web.record.not_saved', failure instanceof Error ? failure.message : String(failure)));
    }
    this.update();
  }
}
