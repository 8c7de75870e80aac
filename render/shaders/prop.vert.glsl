// Props, in world coordinates.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 card_in;
layout(location = 3) in vec4 paint_in;
layout(location = 4) in uint id_in;

out vec3 world;
out vec3 normal;
out vec2 card;
flat out vec4 paint;
flat out uint id;
flat out int card_number;

void main() {
  world = position;
  normal = normal_in;
  card = card_in;
  paint = paint_in;
  id = id_in;
  card_number = gl_VertexID / 4;
  gl_Position = project(position);
}
