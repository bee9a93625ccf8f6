/** The joint's stiffness: a number, what it is made of, and its last half minute beside the angle. */
import uPlot from 'uplot';
import { el } from '../app/dom';
import type { App } from '../app/state';
import { Throttle } from '../app/throttle';
import type { JointReading, Readings } from '../wire/moment';

const SHOWN_S = 30;
/** Points of the plot a second: finer is not seen in so narrow a plot. */
const POINTS_HZ = 10;
const SHOW_EVERY_MS = 200;
const HEIGHT_PX = 150;

/** They add up to K: what finite elements add to the stiffness of lines is one part, K_bulk. */
const PARTS = ['K_muscle', 'K_geometry', 'K_bulk', 'K_contact', 'K_passive'] as const;
type PartKey = (typeof PARTS)[number];

export class StiffnessView {
  readonly element = el('div', { class: 'stiffness' });
  private readonly number = el('output', { class: 'big-number' });
  private readonly angle = el('p', { class: 'quiet' });
  private readonly parts = el('dl', { class: 'parts' });
  private readonly chart = el('div', { class: 'chart' });
  private readonly values = new Map<PartKey, HTMLElement>();
  private readonly joint: number;
  private plot: uPlot | null = null;
  private readonly track: { time_s: number; stiffness: number; angle_deg: number }[] = [];
  // The last one is shown, too: a recording may stand still after it.
  private readonly shows = new Throttle<JointReading>(SHOW_EVERY_MS, (joint) => this.show(joint));

  constructor(private readonly app: App) {
    const key = app.scene.co_contraction?.joint;
    this.joint = Math.max(
      0,
      app.scene.joints.findIndex((joint) => joint.key === key),
    );
    for (const part of PARTS) this.addPart(part);
    this.element.append(this.number, this.angle, this.chart, this.parts);
    app.on('readings', (readings) => this.take(readings));
    app.on('language', () => this.rebuild());
    new ResizeObserver(() => this.resize()).observe(this.chart);
  }

  private addPart(part: PartKey): void {
    const value = el('dd');
    this.values.set(part, value);
    this.parts.append(this.app.texts.bind(el('dt'), `demonstrate.${part}`), value);
  }

  private take(readings: Readings): void {
    const joint = readings.joints[this.joint];
    if (joint === undefined) return;
    this.remember(readings.time_s, joint);
    this.shows.push(joint);
  }

  private remember(time_s: number, joint: JointReading): void {
    const last = this.track[this.track.length - 1];
    // A reset, or a recording that jumped back, begins a new plot.
    if (last !== undefined && time_s < last.time_s) this.track.length = 0;
    else if (last !== undefined && time_s - last.time_s < 1 / POINTS_HZ) return;
    this.track.push({ time_s, stiffness: joint.stiffness_Nm_rad, angle_deg: degrees(joint.angle_rad) });
    while (this.track[0]!.time_s < time_s - SHOWN_S) this.track.shift();
  }

  private show(joint: JointReading): void {
    const { texts } = this.app;
    this.number.textContent = texts.t(
      joint.stiffness_Nm_rad < 0 ? 'demonstrate.K_unstable' : 'demonstrate.K',
      joint.stiffness_Nm_rad,
    );
    this.angle.textContent = texts.t('demonstrate.torque', joint.torque_Nm, degrees(joint.angle_rad));
    const sum = (of: (muscle: JointReading['muscles'][number]) => number): number =>
      joint.muscles.reduce((total, muscle) => total + of(muscle), 0);
    const others = {
      K_muscle: sum((muscle) => muscle.line_muscle_Nm_rad),
      K_geometry: sum((muscle) => muscle.line_geometry_Nm_rad),
      K_contact: joint.contact_Nm_rad,
      K_passive: joint.passive_Nm_rad,
    };
    const known = Object.values(others).reduce((total, part) => total + part, 0);
    const parts: Record<PartKey, number> = { ...others, K_bulk: joint.stiffness_Nm_rad - known };
    for (const [part, value] of this.values) value.textContent = parts[part].toFixed(3);
    this.draw();
  }

  private draw(): void {
    const latest_s = this.track[this.track.length - 1]?.time_s ?? 0;
    const data: uPlot.AlignedData = [
      this.track.map((point) => point.time_s - latest_s),
      this.track.map((point) => point.stiffness),
      this.track.map((point) => point.angle_deg),
    ];
    if (this.plot === null) this.build(data);
    else this.plot.setData(data);
  }

  private build(data: uPlot.AlignedData): void {
    const width = this.chart.clientWidth;
    if (width === 0) return;
    const style = getComputedStyle(this.element);
    const [ink, line, first, second] = ['--quiet', '--line', '--plot-1', '--plot-2'].map((name) =>
      style.getPropertyValue(name).trim(),
    );
    const axis = {
      stroke: ink!,
      grid: { stroke: line!, width: 1 },
      ticks: { show: false },
      font: '11px system-ui',
      size: 34,
    };
    const { texts } = this.app;
    this.plot = new uPlot(
      {
        width,
        height: HEIGHT_PX,
        cursor: { show: false },
        legend: { show: true, live: false },
        scales: {
          x: { time: false, range: () => [-SHOWN_S, 0] },
          K: { range: roomy(0.2) },
          angle: { range: roomy(4) },
        },
        series: [
          { label: 's' },
          { label: texts.t('web.stiffness.K'), scale: 'K', stroke: first!, width: 2 },
          { label: texts.t('web.stiffness.angle'), scale: 'angle', stroke: second!, width: 1.5, dash: [4, 3] },
        ],
        axes: [
          { ...axis, size: 22 },
          { ...axis, scale: 'K' },
          { ...axis, scale: 'angle', side: 1, grid: { show: false } },
        ],
      },
      data,
      this.chart,
    );
  }

  private resize(): void {
    if (this.plot !== null && this.chart.clientWidth > 0) {
      this.plot.setSize({ width: this.chart.clientWidth, height: HEIGHT_PX });
    }
  }

  private rebuild(): void {
    this.plot?.destroy();
    this.plot = null;
  }
}

const degrees = (angle_rad: number): number => (angle_rad * 180) / Math.PI;

/** A range of at least `least`, so that noise does not fill the plot. */
function roomy(least: number): uPlot.Range.Function {
  return (_, low, high) => {
    const [from, to] = [low ?? 0, high ?? 0];
    const middle = (from + to) / 2;
    const half = Math.max(0.55 * (to - from), least / 2);
    return [middle - half, middle + half];
  };
}
