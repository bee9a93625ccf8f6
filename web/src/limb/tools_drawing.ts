/** The hands in the scene: balls, and of the own one a thin thread from where the tool is to where the hand is. */
import {
  BufferAttribute,
  BufferGeometry,
  Line,
  LineBasicMaterial,
  Mesh,
  MeshBasicMaterial,
  Object3D,
  SphereGeometry,
  ShaderMaterial,
  Color,
} from 'three';
import type { ToolReading } from '../wire/moment';
import type { Point } from './vectors';

const vertexShader = `varying vec3 v_normal;
void main() {
  v_normal = normalMatrix * normal;
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;
const fragmentShader = `varying vec3 v_normal;
uniform vec3 tint;
void main() {
  vec3 n = normalize(v_normal);
  float light = 0.45 + 0.6 * max(dot(n, vec3(-0.42, 0.57, 0.71)), 0.0);
  float shine = pow(max(dot(n, vec3(-0.227, 0.308, 0.924)), 0.0), 24.0);
  gl_FragColor = vec4(pow(tint * light + 0.4 * shine, vec3(0.4545)), 1.0);
}`;

const OWN = 0x0b7f86;
const OTHERS = 0x5a6b8c;

/** The server tells of hands that nobody has, too: they touch and hold nothing. */
export function isAtWork({ in_contact, line }: ToolReading): boolean {
  return in_contact || line >= 0;
}

export class ToolsDrawing {
  readonly group = new Object3D();
  private readonly ball = new SphereGeometry(1, 20, 14);
  private readonly own = this.makeBall(OWN);
  private readonly others: Mesh[] = [];
  private readonly thread: Line<BufferGeometry, LineBasicMaterial>;
  private readonly hand: Mesh;

  constructor() {
    const ends = new BufferGeometry().setAttribute('position', new BufferAttribute(new Float32Array(6), 3));
    this.thread = new Line(ends, new LineBasicMaterial({ color: OWN, depthTest: false, transparent: true }));
    this.hand = new Mesh(this.ball, new MeshBasicMaterial({ color: OWN, depthTest: false, transparent: true }));
    this.thread.frustumCulled = false;
    this.thread.renderOrder = this.hand.renderOrder = 2;
    this.group.add(this.own, this.thread, this.hand);
    this.setOwn(null);
  }

  /** Where the tool is seen, and where the hand is; null: no hand. */
  setOwn(own: { proxy_m: Point; hand_m: Point; radius_m: number } | null): void {
    this.own.visible = this.thread.visible = this.hand.visible = own !== null;
    if (own === null) return;
    this.own.position.set(...own.proxy_m);
    this.own.scale.setScalar(own.radius_m);
    this.hand.position.set(...own.hand_m);
    this.hand.scale.setScalar(0.25 * own.radius_m);
    const ends = this.thread.geometry.attributes['position'] as BufferAttribute;
    ends.set([...own.proxy_m, ...own.hand_m]);
    ends.needsUpdate = true;
  }

  /** Those of other members that touch or hold something. */
  setOthers(tools: readonly ToolReading[]): void {
    while (this.others.length < tools.length) {
      const ball = this.makeBall(OTHERS);
      this.others.push(ball);
      this.group.add(ball);
    }
    this.others.forEach((ball, i) => {
      const tool = tools[i];
      ball.visible = tool !== undefined;
      if (tool === undefined) return;
      ball.position.set(...tool.proxy_m);
      ball.scale.setScalar(tool.radius_m);
    });
  }

  private makeBall(colour: number): Mesh {
    const uniforms = { tint: { value: new Color(colour) } };
    return new Mesh(this.ball, new ShaderMaterial({ vertexShader, fragmentShader, uniforms }));
  }
}
