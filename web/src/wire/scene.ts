/** SceneKey, SceneDelta and BonePoses, of which a server makes a moment for those who want frames (2). */
import { ByteReader, WireError } from './cursor';
import { FrameType, type Frame } from './frame';
import type { Picture } from './moment';
import { decodeInForce, decodeReadings } from './readings';

/** Edge of the grid that skins lie on [m]. */
const GRID_M = 1e-5;
const LAST_OF_MOMENT = 1;

interface Key {
  number: number;
  places: Int32Array;
}

export class SceneDecoder {
  private readonly keys = new Map<number, Key>();
  private moment = emptyMoment();

  /** The moment that is whole with this frame, or null. */
  take(frame: Frame): Picture | null {
    if (frame.type === FrameType.SceneKey) this.takeKey(frame.payload);
    else if (frame.type === FrameType.SceneDelta) this.takeDelta(frame.payload);
    else if (frame.type === FrameType.BonePoses) this.takePoses(frame.payload);
    else if (frame.type === FrameType.Readings) this.moment.readings = decodeReadings(frame.payload);
    else if (frame.type === FrameType.InForce) this.moment.inForce = decodeInForce(frame.payload);
    else return null;
    if (frame.type === FrameType.SceneKey || (frame.flags & LAST_OF_MOMENT) === 0) return null;
    const whole = this.moment;
    this.moment = emptyMoment();
    return whole;
  }

  private takeKey(payload: Uint8Array): void {
    const reader = new ByteReader(payload);
    const number = reader.u32();
    const skin = reader.u16();
    reader.u16();
    const places = new Int32Array(3 * vertexCount(reader, 12));
    for (let i = 0; i < places.length; ++i) places[i] = reader.i32();
    reader.end();
    this.keys.set(skin, { number, places });
  }

  private takeDelta(payload: Uint8Array): void {
    const reader = new ByteReader(payload);
    const number = reader.u32();
    const skin = reader.u16();
    reader.u16();
    const count = 3 * vertexCount(reader, 3);
    const key = this.keys.get(skin);
    if (key === undefined || key.number !== number || key.places.length !== count) {
      throw new WireError('a skin that refers to a key that did not come');
    }
    const places = new Float32Array(count);
    for (let i = 0; i < count; ++i) places[i] = GRID_M * (key.places[i]! + reader.varint());
    reader.end();
    this.moment.skins.set(skin, places);
  }

  private takePoses(payload: Uint8Array): void {
    const reader = new ByteReader(payload);
    this.moment.sequence = reader.count64();
    this.moment.time_s = reader.f64();
    this.moment.poses = reader.list(() => Float32Array.from(reader.doubles(12)));
    reader.end();
  }
}

function emptyMoment(): Picture {
  return { sequence: 0, time_s: 0, skins: new Map(), poses: null, readings: null, inForce: null };
}

/** A count of vertices that the bytes left can hold. */
function vertexCount(reader: ByteReader, leastBytes: number): number {
  const count = reader.u32();
  if (count * leastBytes > reader.left) throw new WireError('a frame that is shorter than it says');
  return count;
}
