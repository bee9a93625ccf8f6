/** A page that has joined a class. */
import { idToResume, Session } from '../net/session';
import { Priming } from '../net/priming';
import { FrameType } from '../wire/frame';
import { encodePictureSeen } from '../wire/picture';
import { tokenBytes, type Welcome } from '../wire/small';
import { toolStateParts, type ToolState } from '../wire/tool_state';
import { assemble, type Assembly } from './assembly';
import { Feed, type FeedListener } from './feed';
import { takeInvitation } from './invitation';
import { askName, wasLoadedAgain } from './joining';
import { kept } from './storage';
import type { SceneFacts } from './facts';
import { sentenceOf } from './refusals';
import { fetchShade } from './shade';
import type { Texts } from './state';

export async function joinClass(texts: Texts, scene: SceneFacts, lessons: unknown[]): Promise<void> {
  const invitation = takeInvitation();
  const assembly = assemble(texts, scene, lessons);
  const name = await askName(texts, scene, invitation.role);
  const resume_id = wasLoadedAgain() ? BigInt(kept.ofTab.get('resume') ?? '0') : 0n;
  const { page } = assembly;
  page.setMe({ client: 0, name, role: invitation.role, hand: -1 });
  const priming = new Priming();
  const feed = new Feed(
    listenerOf(assembly, (sequence) => session.send(FrameType.PictureSeen, encodePictureSeen(sequence))),
  );
  const session: Session = new Session({
    url: `${location.protocol === 'https:' ? 'wss' : 'ws'}://${location.host}/socket`,
    token: tokenBytes(invitation.token),
    role: invitation.role,
    name,
    resume_id,
    onWelcome: (welcome) => {
      welcomed(assembly, welcome);
      void showsAnother(scene).then((another) => another && session.end('web.net.reload'));
    },
    onFrame: (frame) => {
      priming.take(frame);
      page.tapped(frame.raw);
      feed.take(frame);
    },
    onConnection: (connection) => page.setConnection(connection),
  });
  page.line = {
    send: (control) => session.sendControl(control),
    primingFrames: () => priming.frames(),
    wholePicture: () => feed.wholePicture(),
  };
  assembly.start((state) => sendState(session, state));
  // The server learns at once that a closed page has left; its hand is free for another.
  addEventListener('pagehide', () => session.leave());
}

function sendState(session: Session, state: ToolState): void {
  for (const { type, flags, payload } of toolStateParts(state)) session.send(type, payload, flags);
}

function welcomed({ page }: Assembly, welcome: Welcome): void {
  kept.ofTab.set('resume', idToResume(welcome).toString());
  page.setMe({ ...page.me, client: welcome.client, role: welcome.role, hand: welcome.hand });
  if (welcome.hand < 0 && welcome.role !== 'viewer') page.toast(page.texts.t('web.net.watching'));
}

/** Whether the server has begun anew with another scene or version than this page is of. */
async function showsAnother({ version, name }: SceneFacts): Promise<boolean> {
  try {
    const answer = await fetch('/scene.json');
    if (!answer.ok) return false;
    const now = (await answer.json()) as SceneFacts;
    return now.version !== version || now.name !== name;
  } catch {
    return false; // the link broke again: the next Welcome asks anew
  }
}

function listenerOf({ page, view, hand }: Assembly, seen: (sequence: number) => void): FeedListener {
  let shaded = false;
  return {
    welcome: () => undefined,
    mesh: (mesh) => view.takeMesh(mesh),
    picture: (picture) => {
      view.takePicture(picture);
      page.takePicture(picture);
      seen(picture.sequence);
      if (!shaded) void fetchShade().then((shade) => shade && view.takeShade(shade));
      shaded = true;
    },
    force: (force) => hand.takeForce(force),
    event: (event) => page.toast(page.texts.t(...sentenceOf(event))),
    control: (message) => page.takeControl(message),
  };
}
