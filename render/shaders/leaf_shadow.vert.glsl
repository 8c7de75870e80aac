// Cards of leaves in the shadow map.
layout(location = 0) in vec3 position;
layout(location = 2) in vec2 card_in;

out vec3 card;  // as in prop.vert.glsl

void main() {
  float layer = floor(card_in.x / 2.0);
  card = vec3(card_in.x - 2.0 * layer, card_in.y, layer);
  gl_Position = vec4(shadow_uv(position) * 2.0 - 1.0, position.z * light.shadow_slope.z, 1.0);
}
