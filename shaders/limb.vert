#version 330 core
// Bones and skins. Lit at the vertices: they lie closer together than a light changes, and where there is no graphics
// card a vertex is cheaper than the pixels around it.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;      // 0 .. 1, of a map on the skin
layout(location = 3) in vec2 exposure;    // to the sky: of the part alone, among all parts
layout(location = 4) in float along;      // metres along the muscle
layout(location = 5) in vec2 attachment;  // 1 at the origin, 1 at the insertion

uniform mat4 world_from_model;
uniform mat4 clip_from_world;
uniform vec4 kept;           // half space: n, d
uniform float together;      // 1: all parts are there, 0: each is alone
uniform vec3 eye_world;
uniform vec3 key_world;      // towards the key light, unit
uniform vec4 colour;         // and opacity
uniform vec4 finish;         // metres between stripes or 0, gloss, 1: a cut is seen, 1: the values are mapped
uniform vec3 ends[2];        // colours of origin and insertion
uniform float show_ends;     // 1: an area of attachment is drawn
uniform vec3 map_colours[10];
uniform vec4 glow_place[2];  // place, radius
uniform vec4 glow_colour[2];

out vec4 lit;       // and opacity
out float along_m;

vec3 mapped(float level) {
  float place = clamp(level, 0.0, 1.0) * 9.0;
  int below = min(int(place), 8);
  return mix(map_colours[below], map_colours[below + 1], place - float(below));
}

vec3 painted(vec3 world) {
  vec3 base = mix(colour.rgb, mapped(value), finish.w * smoothstep(0.0, 0.06, value));
  base = mix(base, attachment.y > attachment.x ? ends[1] : ends[0], show_ends);
  for (int i = 0; i < 2; ++i) {
    float far = distance(world, glow_place[i].xyz) / glow_place[i].w;
    base = mix(base, glow_colour[i].rgb, glow_colour[i].a * exp(-4.0 * far * far));
  }
  return base;
}

void main() {
  vec3 world = (world_from_model * vec4(position, 1.0)).xyz;
  vec3 to_eye = normalize(eye_world - world);
  vec3 n = normalize(mat3(world_from_model) * normal);
  if (dot(n, to_eye) < 0.0) n = -n;
  // Warm key light, cool light of the sky, a little from the ground; what is walled in gets less of the sky.
  float seen = mix(exposure.x, exposure.y, together);
  float key = max(0.15 + 0.85 * dot(n, key_world), 0.0);
  vec3 sky = mix(vec3(0.38, 0.35, 0.34), vec3(0.52, 0.55, 0.58), 0.5 + 0.5 * n.z);
  vec3 light = vec3(0.57, 0.55, 0.515) * key * (0.35 + 0.65 * seen) + sky * (0.25 + 0.75 * seen);
  float rim = 1.0 - dot(n, to_eye);
  rim *= rim * rim;
  float shine = pow(max(dot(n, normalize(key_world + to_eye)), 0.0), 28.0) * finish.y * seen;
  // What is looked through shows its outline more than its middle.
  float opacity = colour.a < 0.995 ? clamp(colour.a * (0.75 + 1.1 * rim), 0.0, 1.0) : 1.0;
  lit = vec4(painted(world) * light * (1.0 - 0.30 * rim) + vec3(shine), opacity);
  along_m = along;
  gl_Position = clip_from_world * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(kept, vec4(world, 1.0));
}
