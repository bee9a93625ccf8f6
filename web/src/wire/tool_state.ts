/** What the hand tells the simulation: ToolState, with its ToolContact and ToolGrip before it. */
import { ByteReader, ByteWriter } from './cursor';
import { FrameType } from './frame';

export type Point = [number, number, number];

const WITH_CONTACT = 1;
const WITH_GRIP = 2;
const SMALL = 104;

export interface ToolContact {
  surface: number;
  triangle: number;
  /** They add up to 1; the third travels in ToolState. */
  barycentric: Point;
  /** Out of the tissue. */
  normal: Point;
  /** Where the coupling spring pulls the place. */
  target_m: Point;
  stiffness_N_m: number;
  /** Where the place is believed to be. */
  touched_m: Point;
}

export interface ToolGrip {
  /** Muscle whose line is in hand, body that is; -1: none. */
  line: number;
  body: number;
  /** Along the line, 0 origin to 1 insertion. */
  fraction: number;
  line_stiffness_N_m: number;
  body_point_m: Point;
  body_target_m: Point;
  body_stiffness_N_m: number;
}

export interface ToolState {
  tool_m: Point;
  proxy_m: Point;
  force_N: Point;
  sequence: number;
  model_sequence: number;
  buttons: number;
  faults: number;
  contact: ToolContact | null;
  grip: ToolGrip | null;
}

export interface Part {
  type: number;
  flags: number;
  payload: Uint8Array;
}

const payload = (): ByteWriter => new ByteWriter(new Uint8Array(SMALL));

function contactPart(contact: ToolContact): Part {
  const writer = payload().i32(contact.surface, contact.triangle);
  writer.f64(contact.barycentric[0], contact.barycentric[1], ...contact.normal, ...contact.target_m);
  writer.f64(contact.stiffness_N_m, ...contact.touched_m);
  return { type: FrameType.ToolContact, flags: 0, payload: writer.written() };
}

function gripPart(grip: ToolGrip): Part {
  const writer = payload().i32(grip.line, grip.body).f64(grip.fraction, grip.line_stiffness_N_m);
  writer.f64(...grip.body_point_m, ...grip.body_target_m, grip.body_stiffness_N_m);
  return { type: FrameType.ToolGrip, flags: 0, payload: writer.written() };
}

/** The frames of a state in their order. */
export function toolStateParts(state: ToolState): Part[] {
  const parts = [];
  if (state.contact !== null) parts.push(contactPart(state.contact));
  if (state.grip !== null) parts.push(gripPart(state.grip));
  const writer = payload().f64(...state.tool_m, ...state.proxy_m, ...state.force_N);
  writer.u64(state.sequence).u64(state.model_sequence).u32(state.buttons).u32(state.faults);
  writer.f64(state.contact?.barycentric[2] ?? 0);
  const flags = (state.contact === null ? 0 : WITH_CONTACT) | (state.grip === null ? 0 : WITH_GRIP);
  parts.push({ type: FrameType.ToolState, flags, payload: writer.written() });
  return parts;
}

export function decodeToolContact(bytes: Uint8Array, third: number): ToolContact {
  const reader = new ByteReader(bytes);
  const contact = {
    surface: reader.i32(),
    triangle: reader.i32(),
    barycentric: [reader.f64(), reader.f64(), third] as Point,
    normal: reader.point(),
    target_m: reader.point(),
    stiffness_N_m: reader.f64(),
    touched_m: reader.point(),
  };
  reader.end();
  return contact;
}

export function decodeToolGrip(bytes: Uint8Array): ToolGrip {
  const reader = new ByteReader(bytes);
  const grip = {
    line: reader.i32(),
    body: reader.i32(),
    fraction: reader.f64(),
    line_stiffness_N_m: reader.f64(),
    body_point_m: reader.point(),
    body_target_m: reader.point(),
    body_stiffness_N_m: reader.f64(),
  };
  reader.end();
  return grip;
}

/** Of the ToolState frame alone; its third barycentric coordinate beside it. */
export function decodeToolState(bytes: Uint8Array): { state: ToolState; third: number } {
  const reader = new ByteReader(bytes);
  const state: ToolState = {
    tool_m: reader.point(),
    proxy_m: reader.point(),
    force_N: reader.point(),
    sequence: reader.count64(),
    model_sequence: reader.count64(),
    buttons: reader.u32(),
    faults: reader.u32(),
    contact: null,
    grip: null,
  };
  const third = reader.f64();
  reader.end();
  return { state, third };
}
