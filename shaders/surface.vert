#version 330 core
// Small lit shapes: lines drawn as tubes, tool, proxy, arrow, marks. Lit at the vertices, as shaders/limb.vert.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;

uniform mat4 clip_from_world;
uniform vec3 eye_world;
uniform vec3 key_world;  // towards the key light, unit
uniform float opacity;   // of all

out vec4 lit;

void main() {
  vec3 to_eye = normalize(eye_world - position);
  vec3 n = normalize(normal);
  if (dot(n, to_eye) < 0.0) n = -n;
  float key = max(dot(n, key_world), 0.0);
  float sky = 0.5 + 0.5 * n.z;
  float shine = pow(max(dot(n, normalize(key_world + to_eye)), 0.0), 40.0);
  lit = vec4(colour.rgb * (0.40 + 0.25 * sky + 0.45 * key) + 0.12 * shine, colour.a * opacity);
  gl_Position = clip_from_world * vec4(position, 1.0);
}
