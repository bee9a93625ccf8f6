/**
 * A recording: frames of the server as they came, with their times, and what else a page without a server needs. It
 * lies in the exported page as JSON.
 *
 *   0 s: scene, meshes, pictures since a whole one | frame, frame, frame ... each at its time
 */
import type { SceneFacts } from '../app/facts';
import type { Dictionary } from '../text/texts';

export interface TimedFrame {
  at_ms: number; // since the recording began
  bytes: Uint8Array; // header and all
}

export interface Recording {
  scene: SceneFacts;
  dictionaries: Record<string, Dictionary>;
  shade: Uint8Array; // as `/shade.bin`; empty: none
  frames: TimedFrame[]; // rising in time
}

/** As it lies in the page; bytes as base64. */
interface PackedRecording {
  schema: number;
  scene: SceneFacts;
  dictionaries: Record<string, Dictionary>;
  shade: string;
  frames: [number, string][];
}

const SCHEMA = 1;
export const RECORDING_ID = 'recording';

/** As text for a <script> element: no "<" is left in it, so that nothing in a name ends the element. */
export function recordingText({ scene, dictionaries, shade, frames }: Recording): string {
  const packed = frames.map(({ at_ms, bytes }): [number, string] => [Math.round(at_ms), toBase64(bytes)]);
  const content: PackedRecording = { schema: SCHEMA, scene, dictionaries, shade: toBase64(shade), frames: packed };
  return JSON.stringify(content).replace(/</g, '\\u003c');
}

/** Throws where the text is no recording of this version. */
export function parseRecording(text: string): Recording {
  const packed = JSON.parse(text) as PackedRecording;
  if (packed.schema !== SCHEMA) throw new Error(`a recording of version ${packed.schema}; this page plays ${SCHEMA}`);
  return {
    scene: packed.scene,
    dictionaries: packed.dictionaries,
    shade: fromBase64(packed.shade),
    frames: packed.frames.map(([at_ms, base64]) => ({ at_ms, bytes: fromBase64(base64) })),
  };
}

function toBase64(bytes: Uint8Array): string {
  const PIECE = 0x8000; // arguments that a call surely takes
  let text = '';
  for (let at = 0; at < bytes.length; at += PIECE) text += String.fromCharCode(...bytes.subarray(at, at + PIECE));
  return btoa(text);
}

function fromBase64(base64: string): Uint8Array {
  return Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
}
