// Cards of leaves in the shadow map: light falls through the holes.
in vec3 card;
layout(binding = 5) uniform sampler2DArray leaf_sprites;

void main() {
  if (texture(leaf_sprites, card).r < 0.5) discard;
}
