#version 330 core
// Lit surfaces: bones, skins, lines drawn as tubes, tool, proxy, arrow.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;

uniform mat4 world_from_model;
uniform mat4 clip_from_world;

out vec3 position_world;
out vec3 normal_world;
out vec4 surface_colour;

void main() {
  vec4 world = world_from_model * vec4(position, 1.0);
  position_world = world.xyz;
  normal_world = mat3(world_from_model) * normal;
  surface_colour = colour;
  gl_Position = clip_from_world * world;
}
