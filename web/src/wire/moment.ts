/** What a moment of the scene holds. */

export interface MuscleJoint {
  torque_Nm: number;
  stiffness_Nm_rad: number;
  /** r² k of its line. */
  line_muscle_Nm_rad: number;
  /** -(dr/dq) F of its line. */
  line_geometry_Nm_rad: number;
  /** Positive flexes. */
  moment_arm_m: number;
}

export interface JointReading {
  angle_rad: number;
  torque_Nm: number;
  stiffness_Nm_rad: number;
  preview: boolean;
  passive_Nm_rad: number;
  contact_Nm_rad: number;
  /** By muscle. */
  muscles: MuscleJoint[];
}

export type ToolShape = 'ball' | 'point' | 'clamp';

export interface ToolReading {
  position_m: [number, number, number];
  proxy_m: [number, number, number];
  force_N: [number, number, number];
  radius_m: number;
  shape: ToolShape;
  left: boolean;
  in_contact: boolean;
  stopped: boolean;
  /** Muscle and body in hand, muscle and body touched; -1: none. */
  line: number;
  body: number;
  grip_m: [number, number, number];
  touched_muscle: number;
  touched_body: number;
  line_tension_N: number;
}

export interface Readings {
  sequence: number;
  time_s: number;
  residual_share: number;
  /** By muscle, as all lists down to `lines_m`. */
  activations: Float64Array;
  tensions_N: Float64Array;
  stretches: Float64Array;
  volume_ratios: Float64Array;
  smallest_volume_ratios: Float64Array;
  /** x, y, z of each point in turn, from origin to insertion. */
  lines_m: Float64Array[];
  /** x, y, z of either end. */
  springs_m: Float64Array;
  joints: JointReading[];
  simulation_hz: number;
  haptic_hz: number;
  missed_ticks: number;
  time_factor: number;
  notice: string;
  tools: ToolReading[];
}

export interface InForce {
  drive: 'script' | 'levels' | 'balance';
  driver: 'script' | 'window' | 'lesson' | 'network';
  hold_posture: boolean;
  gravity: boolean;
  paused: boolean;
  recording: boolean;
  flexors: number;
  extensors: number;
  common: number;
  difference: number;
  common_now: number;
}

export interface Picture {
  sequence: number;
  time_s: number;
  /** Of the muscles whose skin changed: x, y, z of each vertex in turn [m, world]. */
  skins: Map<number, Float32Array>;
  /** Of each body, 3x4 by rows: from the specimen's files to the world. */
  poses: Float32Array[];
  readings: Readings | null;
  inForce: InForce | null;
}
