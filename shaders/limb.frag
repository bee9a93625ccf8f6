#version 330 core
in vec3 position_world;
in vec3 normal_world;
in vec4 facts;  // value, light of the sky, along, which end

uniform vec3 eye_world;
uniform vec3 key_world;      // towards the key light, unit
uniform vec4 colour;         // and opacity
uniform vec4 finish;         // metres between stripes or 0, gloss, 1: a cut is seen, 1: the values are mapped
uniform vec3 ends[2];        // colours of origin and insertion
uniform float show_ends;     // 1: an area of attachment is drawn
uniform vec3 map_colours[10];
uniform vec4 glow_place[2];  // place, radius
uniform vec4 glow_colour[2];

out vec4 fragment;

vec3 mapped(float level) {
  float place = clamp(level, 0.0, 1.0) * 9.0;
  int below = min(int(place), 8);
  return mix(map_colours[below], map_colours[below + 1], place - float(below));
}

void main() {
  if (finish.z > 0.5 && !gl_FrontFacing) {
    // The inside, seen through a section, is painted flat: it looks like the cut face.
    fragment = vec4(colour.rgb * 0.62, 1.0);
    return;
  }
  vec3 base = colour.rgb;
  if (finish.w > 0.5) base = mix(base, mapped(facts.x), smoothstep(0.0, 0.06, facts.x));
  if (show_ends > 0.5) base = facts.w > 0.0 ? ends[1] : ends[0];
  if (finish.x > 0.0) {
    float from_stripe = abs(fract(facts.z / finish.x) - 0.5) * finish.x;
    float width = 0.0006, soft = fwidth(facts.z);
    base *= 1.0 - 0.38 * (1.0 - smoothstep(width, width + soft, from_stripe));
  }
  for (int i = 0; i < 2; ++i) {
    float far = distance(position_world, glow_place[i].xyz) / glow_place[i].w;
    base = mix(base, glow_colour[i].rgb, glow_colour[i].a * exp(-4.0 * far * far));
  }
  vec3 to_eye = normalize(eye_world - position_world);
  vec3 n = normalize(normal_world);
  if (dot(n, to_eye) < 0.0) n = -n;
  float facing = dot(n, to_eye);
  // Warm key light, cool light of the sky, a little from the ground; what is walled in gets less of the sky.
  float key = max(0.15 + 0.85 * dot(n, key_world), 0.0);
  float sky = 0.5 + 0.5 * n.z;
  float open = 0.25 + 0.75 * facts.y;
  vec3 light = vec3(0.52, 0.50, 0.47) * key * (0.35 + 0.65 * facts.y) + mix(vec3(0.38, 0.35, 0.34), vec3(0.52, 0.55, 0.58), sky) * open;
  float rim = 1.0 - facing;
  rim *= rim * rim;
  float shine = pow(max(dot(n, normalize(key_world + to_eye)), 0.0), 28.0) * finish.y * facts.y;
  vec3 lit = base * light * (1.0 - 0.30 * rim) + vec3(shine);
  // What is looked through shows its outline more than its middle.
  float opacity = colour.a < 0.995 ? clamp(colour.a * (0.75 + 1.1 * rim), 0.0, 1.0) : 1.0;
  fragment = vec4(lit, opacity);
}
