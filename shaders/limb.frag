#version 330 core
in vec4 lit;  // and opacity
in float along_m;

uniform vec4 colour;  // and opacity
uniform vec4 finish;  // metres between stripes or 0, gloss, 1: a cut is seen, 1: the values are mapped

out vec4 fragment;

void main() {
  if (finish.z > 0.5 && !gl_FrontFacing) {
    // The inside, seen through a section, is painted flat: it looks like the cut face.
    fragment = vec4(colour.rgb * 0.62, 1.0);
    return;
  }
  fragment = lit;
  if (finish.x > 0.0) {
    const float width = 0.0006;
    float from_stripe = abs(fract(along_m / finish.x) - 0.5) * finish.x;
    fragment.rgb *= 0.62 + 0.38 * smoothstep(width, width + fwidth(along_m), from_stripe);
  }
}
