#version 330 core
// Bones and skins in a studio's light: a warm key light, a cool sky, what is walled in darker and warmer. Lit at the
// vertices: they lie closer together than light changes, and where there is no graphics card each triangle costs some
// dozens of pixels, however small it is. Light is added up linearly and handed on as its root: limb.frag multiplies it
// with sRGB colours.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal_value;  // and 0 .. 1, of a map on the skin
layout(location = 2) in vec4 along_fibre;   // direction of the fibres, or 0
layout(location = 3) in vec2 exposure;      // to the sky: of the part alone, among all parts
layout(location = 4) in vec4 tissue;        // metres along the muscle; 1 at the origin; 1 at the insertion; tendon
layout(location = 5) in vec3 strand;        // metres across the strands of the muscle

uniform mat4 world_from_model;
uniform mat4 clip_from_world;
uniform vec4 kept;           // half space: n, d
uniform float together;      // 1: all parts are there, 0: each is alone
uniform vec3 eye_world;
uniform vec3 key_world;      // towards the key light, unit
uniform vec3 tissues[2];     // colours of belly and tendon, or of bone
uniform vec4 finish;         // metres between stripes or 0; gloss; 1: a cut is seen; 1: of fibres
uniform float opacity;
uniform vec4 overlay;        // colour of the part, and its share over the look
uniform float mapped_share;  // of a map on the skin over all that, where it is not 0
uniform vec3 ends[2];        // colours of origin and insertion
uniform float show_ends;     // 1: an area of attachment is drawn
uniform vec3 map_colours[10];
uniform vec4 glow_place[2];  // place, radius
uniform vec4 glow_colour[2];

out vec4 light_shine;  // root of the light, and what shines white
out vec4 laid_over;    // colour, share
out vec4 strand_along; // metres across the strands; metres along the muscle
out vec2 tendon_covers;

vec3 mapped(float level) {
  float place = clamp(level, 0.0, 1.0) * 9.0;
  int below = min(int(place), 8);
  return mix(map_colours[below], map_colours[below + 1], place - float(below));
}

/// `over` with another colour, of that share, over it.
vec4 laid_on(vec4 over, vec3 colour, float share) {
  float both = share + over.a * (1.0 - share);
  return both > 0.0 ? vec4(mix(over.rgb, colour, share / both), both) : over;
}

vec4 laid_over_at(vec3 world) {
  vec4 over = overlay;
  float value = normal_value.w;
  over = laid_on(over, mapped(value), mapped_share * smoothstep(0.0, 0.06, value));
  over = laid_on(over, tissue.z > tissue.y ? ends[1] : ends[0], show_ends);
  for (int i = 0; i < 2; ++i) {
    float far = distance(world, glow_place[i].xyz) / glow_place[i].w;
    over = laid_on(over, glow_colour[i].rgb, glow_colour[i].a * exp(-4.0 * far * far));
  }
  return over;
}

void main() {
  vec3 world = (world_from_model * vec4(position, 1.0)).xyz;
  vec3 to_eye = normalize(eye_world - world);
  vec3 n = normalize(mat3(world_from_model) * normal_value.xyz);
  if (dot(n, to_eye) < 0.0) n = -n;
  float seen = mix(exposure.x, exposure.y, together);
  // Light that bounces in a crevice takes on the colour of its walls.
  vec3 own = mix(tissues[0], tissues[1], tissue.w);
  vec3 open = seen / (seen + (1.0 - seen) * (1.6 - 0.9 * own));
  // Flesh lets light in: its shadow begins later, and in red.
  vec3 wrap = mix(vec3(0.08), vec3(0.30, 0.14, 0.12), finish.w);
  vec3 key = max((dot(n, key_world) + wrap) / (1.0 + wrap), 0.0);
  vec3 sky = mix(vec3(0.25, 0.215, 0.20), vec3(0.37, 0.40, 0.44), 0.5 + 0.5 * n.z);
  vec3 light = vec3(0.92, 0.86, 0.78) * key * key * (0.25 + 0.75 * open) + sky * open * (0.25 + 0.75 * open);
  // Fascia: a moist sheen along the fibres, and light that grazes it.
  vec3 half_way = normalize(key_world + to_eye);
  float straight = max(dot(n, half_way), 0.0);
  float along = dot(along_fibre.xyz, half_way);
  float silk = pow(max(1.0 - along * along, 0.0), 8.0) * straight * straight + 0.55 * pow(straight, 40.0);
  float sheen = mix(pow(straight, 24.0), silk, finish.w * step(0.25, dot(along_fibre.xyz, along_fibre.xyz)));
  float rim = 1.0 - dot(n, to_eye);
  rim *= rim * rim;
  float shine = finish.y * (1.0 + 0.6 * tissue.w) * seen * (sheen + 0.3 * rim);
  light_shine = vec4(sqrt(light) * (1.0 - 0.28 * rim), shine);
  laid_over = laid_over_at(world);
  strand_along = vec4(strand, tissue.x);
  // What is looked through shows its outline more than its middle.
  tendon_covers = vec2(tissue.w, opacity < 0.995 ? clamp(opacity * (0.75 + 1.1 * rim), 0.0, 1.0) : 1.0);
  gl_Position = clip_from_world * vec4(world, 1.0);
  gl_ClipDistance[0] = dot(kept, vec4(world, 1.0));
}
