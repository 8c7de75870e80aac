// Skin, hair and clothes. With COVERAGE only the silhouette is written.
in vec3 world;
in vec2 uv;
in vec2 received;
flat in vec3 tint;
flat in uint layer;
flat in uint id;

layout(binding = 0) uniform sampler2DArray textures;

#ifdef COVERAGE
layout(location = 0) out float covered;
#else
layout(location = 0) out vec4 colour;
layout(location = 1) out uint instance;
#endif

void main() {
#if !defined(COVERAGE) || defined(ALPHA_TEST)
  vec4 texel = texture(textures, vec3(uv, float(layer)));
#endif
#ifdef ALPHA_TEST
  if (texel.a < 0.5) discard;
#endif
#ifdef COVERAGE
  covered = 1.0;
#else
  vec3 albedo = texel.rgb * tint;
  float sun = received.x * sunlit(world, 0.06);
  vec3 ambient = mix(light.bounce.rgb, light.sky.rgb, received.y);
  vec3 radiance = albedo * (light.sun.rgb * sun + ambient);
  colour = vec4(film(through_air(radiance, 1.0 / gl_FragCoord.w)), 1.0);
  instance = id;
#endif
}
