#version 330 core
in vec3 position_world;
in vec3 normal_world;
in vec4 surface_colour;

uniform vec3 eye_world;

out vec4 fragment;

void main() {
  vec3 to_eye = normalize(eye_world - position_world);
  vec3 n = normalize(normal_world);
  if (dot(n, to_eye) < 0.0) n = -n;
  // Sky from above, a key light over the viewer's left shoulder, a soft rim that sets neighbours apart.
  float sky = 0.5 + 0.5 * n.z;
  vec3 left = normalize(cross(vec3(0.0, 0.0, 1.0), to_eye) + vec3(1e-4, 0.0, 0.0));
  vec3 key = normalize(to_eye - 0.5 * left + vec3(0.0, 0.0, 0.7));
  float diffuse = max(dot(n, key), 0.0);
  float shine = pow(max(dot(n, normalize(key + to_eye)), 0.0), 40.0);
  float rim = pow(1.0 - max(dot(n, to_eye), 0.0), 3.0);
  vec3 lit = surface_colour.rgb * (0.30 + 0.25 * sky + 0.55 * diffuse) + 0.12 * shine - 0.18 * rim * surface_colour.rgb;
  fragment = vec4(lit, surface_colour.a);
}
