// A person's silhouette, rendered on its own.
in vec2 uv;
flat in uint layer;

layout(binding = 0) uniform sampler2DArray textures;

layout(location = 0) out float covered;

void main() {
#ifdef ALPHA_TEST
  if (texture(textures, vec3(uv, float(layer))).a < 0.5) discard;
#endif
  covered = 1.0;
}
