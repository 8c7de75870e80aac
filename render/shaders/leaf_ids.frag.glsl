// Ids of cards of leaves alone, with the holes between the leaves.
in vec3 card;  // as in prop.frag.glsl
flat in uint id;
layout(binding = 5) uniform sampler2DArray leaf_sprites;

layout(location = 1) out uint instance;

void main() {
  if (texture(leaf_sprites, card).r < 0.5) discard;
  instance = id;
}
