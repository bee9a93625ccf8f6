/** The felt force as a tone, and as a phone's vibration: for hands that have no device. */
import type { App } from '../app/state';

/** Of the scale's end [N]. */
const FULL_N = 3;
const LOW_HZ = 110;
const OCTAVES = 2;
const LOUDEST = 0.18;
const FADE_S = 0.04;
/** Below this nothing is felt. */
const LEAST_N = 0.03;
const VIBRATE_EVERY_MS = 100;

export class Tone {
  private context: AudioContext | null = null;
  private oscillator: OscillatorNode | null = null;
  private gain: GainNode | null = null;
  private vibrated_ms = 0;
  private on = false;

  constructor(private readonly app: App) {
    app.on('touch', ({ force_N }) => this.follow(force_N));
  }

  /** Browsers let a page sound after a click only. */
  turn(on: boolean): void {
    this.on = on;
    if (on && this.context === null) this.open();
    if (on) void this.context?.resume();
    else this.follow(0);
  }

  private open(): void {
    const context = new AudioContext();
    const gain = new GainNode(context, { gain: 0 });
    const oscillator = new OscillatorNode(context, { type: 'triangle', frequency: LOW_HZ });
    oscillator.connect(gain).connect(context.destination);
    oscillator.start();
    [this.context, this.gain, this.oscillator] = [context, gain, oscillator];
  }

  private follow(force_N: number): void {
    const felt = force_N < LEAST_N ? 0 : Math.min(1, force_N / FULL_N);
    const loudness = this.on ? LOUDEST * Math.sqrt(felt) : 0;
    const at_s = this.context?.currentTime ?? 0;
    this.gain?.gain.setTargetAtTime(loudness, at_s, FADE_S);
    this.oscillator?.frequency.setTargetAtTime(LOW_HZ * 2 ** (OCTAVES * felt), at_s, FADE_S);
    if (felt > 0) this.vibrate(felt);
  }

  /** Motors of phones know on and off only: the share of the time that they run says how strong. */
  private vibrate(felt: number): void {
    const now_ms = performance.now();
    if (now_ms - this.vibrated_ms < VIBRATE_EVERY_MS || this.app.connection.state !== 'joined') return;
    this.vibrated_ms = now_ms;
    navigator.vibrate?.(Math.max(8, 0.9 * VIBRATE_EVERY_MS * felt));
  }
}
