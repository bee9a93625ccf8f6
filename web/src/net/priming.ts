/** The frames that one needs to begin to look now, beside a whole picture: what the scene is, and its meshes. */
import { FrameType } from '../wire/frame';
import type { ReceivedFrame } from './frame_stream';

export class Priming {
  private lasting: Uint8Array[] = [];

  take({ type, payload, raw }: ReceivedFrame): void {
    if (type === FrameType.Welcome) this.lasting = [raw];
    else if (type === FrameType.Mesh || (type === FrameType.Control && isScene(payload))) this.lasting.push(raw);
  }

  frames(): Uint8Array[] {
    return [...this.lasting];
  }
}

const SCENE_START = new TextEncoder().encode('{"scene"');

function isScene(payload: Uint8Array): boolean {
  return SCENE_START.every((byte, i) => payload[i] === byte);
}
