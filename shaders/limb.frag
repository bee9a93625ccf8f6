#version 330 core
// Flesh with its strands, tendon and bone, and what is laid over them, in the light of limb.vert.
in vec4 light_shine;   // root of the light, and what shines white
in vec4 laid_over;     // colour, share
in vec4 strand_along;  // metres across the strands; metres along the muscle
in vec2 tendon_covers;

uniform vec3 tissues[2];  // colours of belly and tendon, or of bone
uniform vec4 finish;      // metres between stripes or 0; gloss; 1: a cut is seen; 1: of fibres

out vec4 fragment;

/// Waves across the strands, of 4 lengths and directions, periods a metre: bundles of 5 mm down to fibres of 0.7 mm.
/// Near no rational ratio, so that they never repeat on a muscle.
const vec4 kWaveX = vec4(92.0, -288.0, 361.0, 962.0);
const vec4 kWaveY = vec4(-131.0, 172.0, 623.0, -917.0);
const vec4 kWaveZ = vec4(144.0, 267.0, -347.0, 689.0);
const vec4 kWaveLength = vec4(215.0, 429.0, 799.0, 1497.0);  // of these three together
const vec4 kWaveShare = vec4(0.20, 0.29, 0.28, 0.23);
const vec3 kBend = vec3(0.5, 0.9, 1.3);  // of the finer waves by the first: else they would look woven

/// -1 .. 1 across the strands. A wave that is shorter than two and a half pixels has faded out: no moire at any
/// distance.
float strands(float pixel_m) {
  vec4 shown = clamp(1.5 - 2.6 * pixel_m * kWaveLength, 0.0, 1.0) * kWaveShare;
  vec4 periods = strand_along.x * kWaveX + strand_along.y * kWaveY + strand_along.z * kWaveZ;
  periods.yzw += kBend * abs(fract(periods.x) - 0.5);
  // Near a sine, and cheaper without a graphics card.
  vec4 saw = 1.0 - 4.0 * abs(fract(periods) - 0.5);
  return dot(saw * (1.5 - 0.5 * saw * saw), shown);
}

void main() {
  if (finish.z > 0.5 && !gl_FrontFacing) {
    // The inside, seen through a section, is painted flat: it looks like the cut face.
    fragment = vec4(mix(tissues[0], laid_over.rgb, laid_over.a) * 0.75, 1.0);
    return;
  }
  vec3 right = dFdx(strand_along.xyz), up = dFdy(strand_along.xyz);
  float pixel_m = sqrt(dot(right, right) + dot(up, up));  // its diagonal
  float strand = finish.w * strands(pixel_m);
  // Strands of tendon reach in between those of the belly.
  float tendon = tendon_covers.x;
  tendon = smoothstep(0.2, 0.8, tendon + 2.2 * strand * tendon * (1.0 - tendon));
  vec3 own = mix(tissues[0], tissues[1], tendon) * (1.0 + (0.30 - 0.20 * tendon) * strand);
  // What is laid over the look tints it, and leaves its strands and, half, its tendons.
  vec3 colour = mix(own, laid_over.rgb * (1.0 + 0.15 * strand), laid_over.a * (1.0 - 0.45 * tendon * finish.w));
  const float kHalfWidth_m = 0.0006;
  float away_m = finish.x > 0.0 ? abs(fract(strand_along.w / finish.x) - 0.5) * finish.x : 1.0;
  colour *= 0.70 + 0.30 * smoothstep(kHalfWidth_m, kHalfWidth_m + pixel_m, away_m);
  colour *= light_shine.rgb;
  colour += (1.0 - min(colour, 1.0)) * light_shine.a * (1.0 + 0.6 * strand);
  fragment = vec4(colour, tendon_covers.y);
}
