#version 330 core
// Unlit lines: the ground grid, strokes along fibres.
layout(location = 0) in vec3 position;
layout(location = 2) in vec4 colour;

uniform mat4 clip_from_world;

out vec4 line_colour;

void main() {
  line_colour = colour;
  gl_Position = clip_from_world * vec4(position, 1.0);
}
