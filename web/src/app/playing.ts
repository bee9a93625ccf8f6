/** A page that plays a recording: nobody hears what it sends, and there is no hand. */
import type { OpenedRecording } from '../record/open_recording';
import { WireError } from '../wire/cursor';
import { assemble } from './assembly';
import { Feed } from './feed';
import type { Texts } from './state';

export function playRecording(texts: Texts, recording: OpenedRecording): void {
  const { facts, lessons, shade, player } = recording;
  const assembly = assemble(texts, facts, lessons);
  const { page, view } = assembly;
  page.setConnection({ state: 'playing' });
  let shaded = false;
  const feed = new Feed({
    welcome: () => undefined,
    mesh: (mesh) => view.takeMesh(mesh),
    picture: (picture) => {
      view.takePicture(picture);
      page.takePicture(picture);
      if (!shaded) view.takeShade(shade);
      shaded = true;
    },
    force: () => undefined,
    event: () => undefined,
    control: (message) => page.takeControl(message),
  });
  page.line = { send: () => undefined, primingFrames: () => [], wholePicture: () => null };
  assembly.start(() => undefined);
  recording.mount(page);
  player.start((raw) => take(feed, raw));
}

function take(feed: Feed, raw: Uint8Array): void {
  try {
    feed.takeRaw(raw);
  } catch (error) {
    if (!(error instanceof WireError)) throw error;
    console.warn(`a frame of the recording: ${error.message}`);
  }
}
