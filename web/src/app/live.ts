/** A page that has joined a class. */
import { Session } from '../net/session';
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
    onWelcome: (welcome) => void welcomed(assembly, welcome),
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

async function welcomed({ page }: Assembly, welcome: Welcome): Promise<void> {
  kept.ofTab.set('resume', welcome.resume_id.toString());
  page.setMe({ ...page.me, client: welcome.client, role: welcome.role, hand: welcome.hand });
  if (welcome.hand < 0 && welcome.role !== 'viewer') page.toast(page.texts.t('web.net.watching'));
  const now = await fetch('/scene.json').then((answer) => answer.json() as Promise<SceneFacts>);
  if (now.version !== page.scene.version || now.name !== page.scene.name) {
    page.setConnection({ state: 'ended', key: 'web.net.reload' });
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
    event: ({ code, text }) => page.toast(code === 'stop' ? page.texts.t('web.net.stopped') : text),
    control: (message) => page.takeControl(message),
  };
}
