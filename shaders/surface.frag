#version 330 core
in vec3 position_world;
in vec3 normal_world;
in vec4 surface_colour;

uniform vec3 eye_world;
uniform vec3 key_world;  // towards the key light, unit
uniform float opacity;   // of all

out vec4 fragment;

void main() {
  vec3 to_eye = normalize(eye_world - position_world);
  vec3 n = normalize(normal_world);
  if (dot(n, to_eye) < 0.0) n = -n;
  float key = max(dot(n, key_world), 0.0);
  float sky = 0.5 + 0.5 * n.z;
  float shine = pow(max(dot(n, normalize(key_world + to_eye)), 0.0), 40.0);
  vec3 lit = surface_colour.rgb * (0.40 + 0.25 * sky + 0.45 * key) + 0.12 * shine;
  fragment = vec4(lit, surface_colour.a * opacity);
}
