// Ground and buildings, in world coordinates.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 local_in;
layout(location = 3) in vec3 light_in;
layout(location = 4) in uint id_in;
layout(location = 5) in float facade_in;
layout(location = 6) in vec4 paint_in;

out vec3 world;
out vec3 ambient;  // light of sky, lamps and bounces on a white surface
out vec4 local;
flat out vec3 normal;
flat out uint id;
flat out float facade_kind;
flat out vec4 paint;

void main() {
  world = position;
  ambient = light_in;
  local = local_in;
  normal = normal_in;
  id = id_in;
  facade_kind = facade_in;
  paint = paint_in;
  gl_Position = project(position);
}
