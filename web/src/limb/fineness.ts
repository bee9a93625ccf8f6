/**
 * How fine the picture is drawn. A software renderer has no time for smooth edges while the limb moves; once it stands
 * still, one picture of twice the size, which the page shrinks, makes up for it.
 */

/** A picture of more pixels than this a pixel of the page is no finer to the eye and costs a phone its frame rate. */
const MOST_PIXEL_RATIO = 2;
const STILL_AFTER_MS = 300;

export class Fineness {
  /** Whether this browser draws without a graphics card. */
  readonly slow = drawsInSoftware();
  private moved_ms = 0;
  private still = false;

  get ratio(): number {
    if (!this.slow) return Math.min(devicePixelRatio, MOST_PIXEL_RATIO);
    return this.still ? MOST_PIXEL_RATIO : 1;
  }

  /** True when the ratio is another now. */
  follow(moving: boolean, now_ms: number): boolean {
    if (moving) this.moved_ms = now_ms;
    const still = now_ms - this.moved_ms > STILL_AFTER_MS;
    const changed = this.slow && still !== this.still;
    this.still = still;
    return changed;
  }
}

function drawsInSoftware(): boolean {
  const gl = document.createElement('canvas').getContext('webgl2');
  if (gl === null) return false;
  const names = gl.getExtension('WEBGL_debug_renderer_info');
  const name = String(gl.getParameter(names?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER));
  gl.getExtension('WEBGL_lose_context')?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
