#version 330 core
// Bones and skins.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float value;       // 0 .. 1, of a map on the skin
layout(location = 3) in vec2 exposure;     // to the sky: of the part alone, among all parts
layout(location = 4) in float along;       // metres along the muscle
layout(location = 5) in vec2 attachment;   // 1 at the origin, 1 at the insertion

uniform mat4 world_from_model;
uniform mat4 clip_from_world;
uniform vec4 kept;  // half space: n, d
uniform float together;

out vec3 position_world;
out vec3 normal_world;
out vec4 facts;  // value, light of the sky, along, which end

void main() {
  vec4 world = world_from_model * vec4(position, 1.0);
  position_world = world.xyz;
  normal_world = mat3(world_from_model) * normal;
  facts = vec4(value, mix(exposure.x, exposure.y, together), along, attachment.y - attachment.x);
  gl_Position = clip_from_world * world;
  gl_ClipDistance[0] = dot(kept, world);
}
