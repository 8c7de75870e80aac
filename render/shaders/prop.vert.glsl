// Props, in world coordinates. With LEAVES: light.glsl comes first.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 card_in;
layout(location = 3) in vec4 paint_in;
layout(location = 4) in uint id_in;
layout(location = 5) in vec3 light_in;

out vec3 world;
out vec3 normal;
flat out vec4 paint;
flat out uint id;
out vec3 ambient;  // light of sky, lamps and bounces on a white surface
#ifdef LEAVES
out vec3 card;  // coordinates on the card, then the sprite's layer
out float sunlit_share;
#endif

void main() {
  world = position;
  normal = normal_in;
  paint = paint_in;
  id = id_in;
  ambient = light_in;
#ifdef LEAVES
  float layer = floor(card_in.x / 2.0);
  card = vec3(card_in.x - 2.0 * layer, card_in.y, layer);
#ifdef NO_SHADOWS
  sunlit_share = 1.0;
#else
  // At the corners of a card: shadows within a crown have no hard edges.
  sunlit_share = sunlit_small(position, 0.7);
#endif
#endif
  gl_Position = project(position);
}
