#version 330 core
// A part grown by some pixels, for its outline.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;

uniform mat4 world_from_model;
uniform mat4 clip_from_world;
uniform vec4 kept;
uniform vec3 grow;  // half of the picture's width and height, and by how much [pixels]

void main() {
  vec4 world = world_from_model * vec4(position, 1.0);
  vec4 clip = clip_from_world * world;
  vec2 out_of = (clip_from_world * vec4(mat3(world_from_model) * normal, 0.0)).xy * grow.xy;
  float length_of = length(out_of);
  if (length_of > 0.0) clip.xy += out_of / length_of * grow.z / grow.xy * clip.w;
  gl_Position = clip;
  gl_ClipDistance[0] = dot(kept, world);
}
