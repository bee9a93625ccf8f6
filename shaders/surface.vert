#version 330 core
// Lit shapes: lines drawn as tubes, tool, proxy, arrow, marks.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;

uniform mat4 clip_from_world;

out vec3 position_world;
out vec3 normal_world;
out vec4 surface_colour;

void main() {
  position_world = position;
  normal_world = normal;
  surface_colour = colour;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
