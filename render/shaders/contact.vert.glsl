// The ground around something that stands on it: a rectangle and what lies within reach of it.
layout(location = 0) in vec4 footprint;  // per instance: middle, half sizes, m
layout(location = 1) in vec4 shade;      // heading's cosine and sine, reach in m, strength
layout(location = 2) in float rounding_in;  // radius of its corners, m

out vec3 world;
out vec2 from_middle;
flat out vec4 extent;  // half sizes, reach, strength
flat out float rounding;

const float kHeight = 0.0019;  // m: above paint, below people (kAboveGround)

void main() {
  vec2 corner = vec2((gl_VertexID & 1) * 2 - 1, (gl_VertexID & 2) - 1);
  from_middle = corner * (footprint.zw + shade.z);
  rounding = rounding_in;
  extent = vec4(footprint.zw, shade.zw);
  vec2 at = footprint.xy + vec2(shade.x * from_middle.x - shade.y * from_middle.y,
                                shade.y * from_middle.x + shade.x * from_middle.y);
  world = vec3(at, kHeight);
  gl_Position = project(world);
}
