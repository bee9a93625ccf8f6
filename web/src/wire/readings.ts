/** Readings and InForce. */
import { ByteReader } from './cursor';
import type { InForce, JointReading, MuscleJoint, Readings, ToolReading } from './moment';

const shapes = ['ball', 'point', 'clamp'] as const;
const drives = ['script', 'levels', 'balance'] as const;
const drivers = ['script', 'window', 'lesson', 'network'] as const;
/** Of the parts of a tool's force, three numbers each, which the page does not show. */
const FORCE_PARTS = 8;

function muscleJoint(reader: ByteReader): MuscleJoint {
  return {
    torque_Nm: reader.f64(),
    stiffness_Nm_rad: reader.f64(),
    line_muscle_Nm_rad: reader.f64(),
    line_geometry_Nm_rad: reader.f64(),
    moment_arm_m: reader.f64(),
  };
}

function joint(reader: ByteReader): JointReading {
  return {
    angle_rad: reader.f64(),
    torque_Nm: reader.f64(),
    stiffness_Nm_rad: reader.f64(),
    preview: reader.flag(),
    passive_Nm_rad: reader.f64(),
    contact_Nm_rad: reader.f64(),
    muscles: reader.list(() => muscleJoint(reader)),
  };
}

function tool(reader: ByteReader): ToolReading {
  const held = {
    position_m: reader.point(),
    proxy_m: reader.point(),
    force_N: reader.point(),
    radius_m: reader.f64(),
    shape: reader.choice(shapes),
    left: reader.flag(),
    in_contact: reader.flag(),
    stopped: reader.flag(),
    line: reader.i32(),
    body: reader.i32(),
    grip_m: reader.point(),
    touched_muscle: reader.i32(),
    touched_body: reader.i32(),
  };
  reader.doubles(3 * FORCE_PARTS);
  const line_tension_N = reader.f64();
  reader.doubles(3); // scales of force and motion, age of what is felt
  return { ...held, line_tension_N };
}

export function decodeReadings(bytes: Uint8Array): Readings {
  const reader = new ByteReader(bytes);
  const numbers = (): Float64Array => reader.doubles(reader.u16());
  const readings: Readings = {
    sequence: reader.count64(),
    time_s: reader.f64(),
    residual_share: reader.f64(),
    activations: numbers(),
    tensions_N: numbers(),
    stretches: numbers(),
    volume_ratios: numbers(),
    smallest_volume_ratios: numbers(),
    lines_m: reader.list(() => reader.doubles(3 * reader.u16())),
    springs_m: reader.doubles(6 * reader.u16()),
    joints: reader.list(() => joint(reader)),
    simulation_hz: reader.f64(),
    haptic_hz: reader.f64(),
    missed_ticks: reader.count64(),
    time_factor: reader.f64(),
    notice: reader.text(reader.u16()),
    tools: reader.list(() => tool(reader)),
  };
  reader.end();
  return readings;
}

export function decodeInForce(bytes: Uint8Array): InForce {
  const reader = new ByteReader(bytes);
  const [drive, driver, set] = [reader.choice(drives), reader.choice(drivers), reader.u8()];
  const state = {
    drive,
    driver,
    hold_posture: (set & 1) !== 0,
    gravity: (set & 2) !== 0,
    paused: (set & 4) !== 0,
    recording: (set & 8) !== 0,
    flexors: reader.f64(),
    extensors: reader.f64(),
    common: reader.f64(),
    difference: reader.f64(),
    common_now: reader.f64(),
  };
  reader.end();
  return state;
}
