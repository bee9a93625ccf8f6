/**
 * How flesh, tendon and bone are drawn: one cheap shader for software renderers, which most phones outrun and a lab
 * computer without a graphics card does not. Light comes over the viewer's left shoulder, so that it shows shape from
 * every side.
 */
import { Color, NormalBlending, ShaderMaterial, Vector4 } from 'three';

const vertexShader = /* glsl */ `
attribute float shade;
varying vec3 v_normal;
varying float v_shade;
#ifdef FLESH
attribute vec3 strand;
attribute float tendon;
varying vec3 v_strand;
varying float v_tendon;
#endif

void main() {
  v_normal = normalMatrix * normal;
  v_shade = shade;
#ifdef FLESH
  v_strand = strand;
  v_tendon = tendon;
#endif
  gl_Position = projectionMatrix * modelViewMatrix * vec4(position, 1.0);
}`;

const fragmentShader = /* glsl */ `
varying vec3 v_normal;
varying float v_shade;
#ifdef FLESH
varying vec3 v_strand;
varying float v_tendon;
#endif
uniform vec3 tissue;
uniform vec3 tendon_tissue;
uniform vec4 laid_over;  // colour of what is shown, share
uniform vec4 mark;       // colour of the rim of what is selected, share
uniform float solid;     // 1; less: shines through
uniform float gloss;

const vec3 kKey = vec3(-0.42, 0.57, 0.71);
const vec3 kFill = vec3(0.85, -0.10, 0.52);
const vec3 kHalf = vec3(-0.227, 0.308, 0.924);  // between the key light and the viewer

#ifdef FLESH
// Near a sine, and cheaper without a graphics card.
float wave(float periods) {
  float saw = 1.0 - 4.0 * abs(fract(periods) - 0.5);
  return saw * (1.5 - 0.5 * saw * saw);
}

// -1 .. 1 across the strands: waves in no simple ratio, bent by the slower ones, else they would look woven.
float strands(vec3 at) {
  float slow = wave(dot(at, vec3(97.0, -132.0, 9.0)));
  float middle = wave(dot(at, vec3(237.0, 212.0, -11.0)) + 0.22 * slow);
  float fine = wave(dot(at, vec3(-493.0, 422.0, 14.0)) + 0.29 * middle);
  return 0.30 * slow + 0.38 * middle + 0.32 * fine;
}
#endif

void main() {
  vec3 n = normalize(v_normal);
  // Towards the viewer as if from far away: one direction less to carry across every triangle.
  float facing = max(n.z, 0.0);
  vec3 own = tissue;
  float shine = gloss;
  float strand = 0.0;
#ifdef FLESH
  strand = strands(v_strand);
  float white = smoothstep(0.25, 0.75, v_tendon + 1.6 * strand * v_tendon * (1.0 - v_tendon));
  own = mix(tissue, tendon_tissue, white) * (1.0 + (0.26 - 0.18 * white) * strand);
  shine *= 1.0 + 0.5 * strand;
  own = mix(own, laid_over.rgb * (1.0 + 0.16 * strand), laid_over.a * (1.0 - 0.4 * white));
#else
  own = mix(own, laid_over.rgb, laid_over.a);
#endif
  float open = mix(0.25, 1.0, v_shade);
  float key = max((dot(n, kKey) + 0.18) / 1.18, 0.0);
  vec3 light = key * vec3(0.92, 0.87, 0.80) * mix(0.5, 1.0, v_shade);
  light += max(dot(n, kFill), 0.0) * vec3(0.10, 0.12, 0.16) * open;
  light += mix(vec3(0.10, 0.08, 0.07), vec3(0.25, 0.27, 0.30), 0.5 + 0.5 * dot(n, viewMatrix[2].xyz)) * open * open;
  vec3 colour = own * light;
  float lit = max(dot(n, kHalf), 0.0);
  float lit2 = lit * lit, lit4 = lit2 * lit2, lit8 = lit4 * lit4;
  colour += shine * (0.35 * lit8 + 0.65 * lit8 * lit8 * lit8) * v_shade;
  float rim = 1.0 - facing;
  colour *= 1.0 - 0.35 * rim * rim * rim;
  colour = mix(colour * (1.0 + 0.25 * mark.a), mark.rgb, mark.a * (0.03 + 0.97 * rim * rim * rim));
  float alpha = solid < 1.0 ? solid * mix(0.55, 1.6, rim * rim) : 1.0;
  gl_FragColor = vec4(sqrt(colour), min(alpha, 1.0));  // near enough to sRGB
}`;

export interface LimbMaterial extends ShaderMaterial {
  uniforms: {
    tissue: { value: Color };
    tendon_tissue: { value: Color };
    laid_over: { value: Vector4 };
    mark: { value: Vector4 };
    solid: { value: number };
    gloss: { value: number };
  };
}

/** Fixed numbers for a part, from its key: the same on every page. */
function variation(key: string): number {
  let hash = 2166136261;
  for (const letter of key) hash = Math.imul(hash ^ letter.charCodeAt(0), 16777619);
  return ((hash >>> 8) & 0xffff) / 0xffff - 0.5;
}

export function fleshMaterial(key: string): LimbMaterial {
  const tissue = new Color(0xa83f35);
  const shift = variation(key);
  tissue.offsetHSL(0.012 * shift, 0.06 * shift, 0.035 * shift);
  return limbMaterial(tissue, 0.16, { FLESH: '' });
}

export function boneMaterial(): LimbMaterial {
  return limbMaterial(new Color(0xd8c7a4), 0.05, {});
}

function limbMaterial(tissue: Color, gloss: number, defines: Record<string, string>): LimbMaterial {
  return new ShaderMaterial({
    vertexShader,
    fragmentShader,
    defines,
    uniforms: {
      tissue: { value: tissue },
      tendon_tissue: { value: new Color(0xe0d2bd) },
      laid_over: { value: new Vector4(0, 0, 0, 0) },
      mark: { value: new Vector4(0, 0, 0, 0) },
      solid: { value: 1 },
      gloss: { value: gloss },
    },
    blending: NormalBlending,
  }) as LimbMaterial;
}

/** 1: as ever; less: shines through and hides nothing. */
export function setSolid(material: LimbMaterial, solid: number): void {
  material.uniforms.solid.value = solid;
  material.transparent = solid < 1;
  material.depthWrite = solid >= 1;
}
