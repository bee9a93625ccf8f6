/** Names beside the limb with lines to what they name. */
import { Vector3, type PerspectiveCamera } from 'three';
import { el } from '../app/dom';
import { vertexOf, type Anchor } from './anchors';
import { placeLabels, type Placed } from './label_layout';
import type { LimbModel } from './model';

const SVG = 'http://www.w3.org/2000/svg';
const GAP_PX = 6;

interface Label {
  anchor: Anchor;
  name: HTMLElement;
  line: SVGPolylineElement;
  dot: SVGCircleElement;
  width: number;
}

export class Labels {
  readonly element = el('div', { class: 'labels', 'aria-hidden': 'true' });
  private readonly lines = document.createElementNS(SVG, 'svg');
  private labels: Label[] = [];

  constructor(private readonly model: LimbModel) {
    this.element.append(this.lines);
  }

  show(anchors: Anchor[], nameOf: (key: string) => string): void {
    this.element.replaceChildren(this.lines);
    this.lines.replaceChildren();
    this.labels = anchors.map((anchor) => {
      const name = el('span', { class: 'label', text: nameOf(anchor.surface.part.key) });
      const line = document.createElementNS(SVG, 'polyline');
      const dot = document.createElementNS(SVG, 'circle');
      dot.setAttribute('r', '3');
      this.lines.append(line, dot);
      this.element.append(name);
      return { anchor, name, line, dot, width: 0 };
    });
    for (const label of this.labels) label.width = label.name.offsetWidth;
  }

  /** Follows the limb and the camera. `margin`: from the picture's edge to the outer end of a name [px]. */
  follow(camera: PerspectiveCamera, width: number, height: number): void {
    const row = width < 500 ? 20 : 26;
    const pins = this.labels.map(({ anchor, width: nameWidth }) => {
      const seen = new Vector3(...vertexOf(this.model, anchor.surface, anchor.vertex).place).project(camera);
      return { x: ((seen.x + 1) / 2) * width, y: ((1 - seen.y) / 2) * height, width: nameWidth };
    });
    const columns = columnsBeside(pins, width);
    placeLabels(pins, height, row).forEach((placed, i) => this.draw(this.labels[i]!, pins[i]!, placed, columns));
  }

  private draw(label: Label, pin: { x: number; y: number }, placed: Placed | null, columns: Columns): void {
    const { name, line, dot } = label;
    name.hidden = placed === null;
    line.setAttribute('visibility', placed === null ? 'hidden' : 'visible');
    dot.setAttribute('visibility', placed === null ? 'hidden' : 'visible');
    if (placed === null) return;
    const left = placed.side === 'left';
    const inner = left ? columns.left : columns.right;
    const x = left ? inner - label.width : inner;
    name.style.transform = `translate(${x.toFixed(1)}px, ${placed.y.toFixed(1)}px) translateY(-50%)`;
    const from = inner + (left ? GAP_PX : -GAP_PX);
    line.setAttribute('points', `${from.toFixed(1)},${placed.y.toFixed(1)} ${pin.x.toFixed(1)},${pin.y.toFixed(1)}`);
    dot.setAttribute('cx', pin.x.toFixed(1));
    dot.setAttribute('cy', pin.y.toFixed(1));
  }
}

interface Columns {
  /** Right end of the names at the left, left end of those at the right. */
  left: number;
  right: number;
}

/** As near to the limb as all names leave it free, within the picture. */
function columnsBeside(pins: { x: number; width: number }[], width: number): Columns {
  const xs = pins.map((pin) => pin.x);
  const widest = Math.max(0, ...pins.map((pin) => pin.width));
  const away = Math.min(90, 0.08 * width);
  const left = Math.max(widest + GAP_PX, Math.min(...xs) - away);
  const right = Math.min(width - widest - GAP_PX, Math.max(...xs) + away);
  return { left, right };
}
