/** A scene that answers at once: touched muscles push back, pulled lines turn the elbow, co-contraction stiffens. */

import { ByteWriter } from '../../src/wire/cursor';
import { encodeWhole } from '../../src/wire/picture';
import type { Point, ToolState } from '../../src/wire/tool_state';
import { elbow } from '../elbow';
import { BODIES, lines, skins } from './limb';

export const HANDS = 4;
const ELBOW = 1;
const PULL_RAD_M = 2; // turn of the elbow for a pull aside
const FLEXORS = 2; // the first muscles
const NONE: Point = [0, 0, 0];

export class World {
  common = 0;
  difference = 0;
  paused = false;
  hold_posture = true;
  gravity = false;
  private readonly hands: (ToolState | null)[] = Array.from({ length: HANDS }, () => null);
  private readonly skins = skins();
  private readonly lines = lines();
  private time_s = 0;
  private sequence = 0;

  hold(hand: number, state: ToolState | null): void {
    this.hands[hand] = state;
  }

  /** On the hand: the spring of what it touches or holds. */
  force(hand: number): Point {
    const { contact, grip } = this.hands[hand] ?? {};
    if (contact) {
      const { target_m, touched_m, stiffness_N_m } = contact;
      return touched_m.map((x, i) => stiffness_N_m * (x - (target_m[i] ?? 0))) as Point;
    }
    return grip && grip.line >= 0 ? [0.5, 0, 0] : NONE;
  }

  picture(dt_s: number): Uint8Array {
    if (!this.paused) this.time_s += dt_s;
    const pose = Float32Array.of(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0);
    const poses = Array.from({ length: BODIES }, () => pose);
    const [readings, inForce] = [this.readings(), this.inForce()];
    return encodeWhole({ sequence: ++this.sequence, time_s: this.time_s, poses, skins: this.skins, readings, inForce });
  }

  private get angle_rad(): number {
    const pulls = this.hands.map((state) => {
      const { grip } = state ?? {};
      const line = grip && this.lines[grip.line];
      if (!state || !grip || !line) return 0;
      const middle = line[1] ?? NONE;
      const aside_m = Math.hypot(...state.tool_m.map((x, i) => x - (middle[i] ?? 0)));
      return (grip.line < FLEXORS ? 1 : -1) * PULL_RAD_M * aside_m;
    });
    return pulls.reduce((sum, turn) => sum + turn, 0.5 * this.difference);
  }

  private inForce(): Uint8Array {
    const set = (this.hold_posture ? 1 : 0) | (this.gravity ? 2 : 0) | (this.paused ? 4 : 0);
    const writer = new ByteWriter(new Uint8Array(43)).u8(2).u8(3).u8(set);
    return writer.f64(this.common, this.common, this.common, this.difference, this.common).written();
  }

  private readings(): Uint8Array {
    const writer = new ByteWriter(new Uint8Array(1 << 16));
    const count = elbow.muscles.length;
    const each = (value: number) => writer.u16(count).f64(...Array.from({ length: count }, () => value));
    writer.u64(this.sequence).f64(this.time_s, 0);
    for (const value of [this.common, 100 * this.common, 1, 1, 1]) each(value);
    writer.u16(count);
    for (const line of this.lines) writer.u16(line.length).f64(...line.flat());
    writer.u16(0).u16(elbow.joints.length);
    elbow.joints.forEach((_, joint) => this.joint(writer, joint === ELBOW ? this.angle_rad : 0));
    writer.f64(100, 1000).u64(0).f64(1).u16(0).u16(HANDS);
    // All of them, used or not: a tool's place in the list is the number of its hand.
    for (let hand = 0; hand < HANDS; ++hand) this.tool(writer, hand);
    return writer.written();
  }

  private joint(writer: ByteWriter, angle_rad: number): void {
    const stiffness = 2 + 6 * this.common;
    writer.f64(angle_rad, 0, stiffness).u8(0).f64(0.1, 0).u16(elbow.muscles.length);
    elbow.muscles.forEach((_, i) => writer.f64(0, 0, (stiffness - 0.1) / 7, 0, i < FLEXORS ? 0.011 : -0.032));
  }

  private tool(writer: ByteWriter, hand: number): void {
    const state = this.hands[hand];
    const muscle = state?.contact && state.contact.surface < elbow.muscles.length ? state.contact.surface : -1;
    const body =
      state?.contact && muscle < 0 ? ([0, 1, 2, 2, 3][state.contact.surface - elbow.muscles.length] ?? -1) : -1;
    writer.f64(...(state?.tool_m ?? NONE), ...(state?.proxy_m ?? NONE), ...this.force(hand), state ? 0.003 : 0);
    writer
      .u8(0)
      .u8(0)
      .u8(state?.contact ? 1 : 0)
      .u8(0)
      .i32(state?.grip?.line ?? -1, -1)
      .f64(...NONE);
    writer.i32(muscle, body).f64(...Array.from({ length: 24 }, () => 0), 5, 1, 1, 0);
  }
}
