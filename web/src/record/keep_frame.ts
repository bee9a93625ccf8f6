/** What of a class may go into a file that others get: the limb, but nobody's name, answer or key to the class. */

import { FrameType, frameBytes, parseFrame } from '../wire/frame';

const LIMB: readonly number[] = [FrameType.Mesh, FrameType.Picture];
const SCENE_START = '{"scene"';
const VIEWER = 0;

/** The frame as it is recorded; null: it is not. */
export function keptFrame(raw: Uint8Array): Uint8Array | null {
  const frame = parseFrame(raw);
  if (LIMB.includes(frame.type)) return raw;
  if (frame.type === FrameType.Welcome) return frameBytes({ ...frame, payload: anonymous(frame.payload) });
  const text = frame.type === FrameType.Control ? new TextDecoder().decode(frame.payload) : '';
  return text.startsWith(SCENE_START) ? raw : null;
}

/** A Welcome without the id that would give its hand to another, and of somebody who watches. */
function anonymous(welcome: Uint8Array): Uint8Array {
  const payload = welcome.slice();
  const view = new DataView(payload.buffer);
  view.setUint32(0, 0, true); // number of the client
  view.setBigUint64(4, 0n, true); // resume id
  view.setInt8(12, -1); // hand
  view.setUint8(13, VIEWER);
  return payload;
}
