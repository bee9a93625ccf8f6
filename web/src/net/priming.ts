/** The frames that one needs to begin to look now, beside a whole picture: what the scene is, and its meshes. */
import { FrameType } from '../wire/frame';
import type { ReceivedFrame } from './frame_stream';

export class Priming {
  private lasting: Uint8Array[] = [];
  private keys = new Map<number, Uint8Array>();

  take(frame: ReceivedFrame): void {
    if (frame.type === FrameType.Welcome) this.clear();
    if (frame.type === FrameType.Welcome || frame.type === FrameType.Mesh) this.lasting.push(frame.raw);
    else if (frame.type === FrameType.Control && isScene(frame.payload)) this.lasting.push(frame.raw);
    else if (frame.type === FrameType.SceneKey) this.keys.set(skinOf(frame.payload), frame.raw);
  }

  frames(): Uint8Array[] {
    return [...this.lasting, ...this.keys.values()];
  }

  private clear(): void {
    this.lasting = [];
    this.keys = new Map();
  }
}

const SCENE_START = new TextEncoder().encode('{"scene"');

function isScene(payload: Uint8Array): boolean {
  return SCENE_START.every((byte, i) => payload[i] === byte);
}

function skinOf(key: Uint8Array): number {
  return key[4]! | (key[5]! << 8);
}
