// Skin, hair and clothes. With LIT_CORNERS light and air come from the corners; with IDS_ONLY only
// ids and silhouettes are written.
#ifdef LIT_CORNERS
in vec3 received;
in vec3 air;
in vec2 uv;
#else
in vec4 world_sun;
in vec3 ambient;
in vec2 uv;
#endif
flat in uvec4 surface;
flat in uvec4 shaded;

layout(binding = 0) uniform sampler2DArray textures;

#ifndef IDS_ONLY
layout(location = 0) out vec4 color;
#endif
layout(location = 1) out uint instance;

vec3 linear_from_srgb(vec3 c) {
  return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

#ifdef LIT_CORNERS
vec3 seen(vec3 albedo) { return albedo * received + air; }
#else
vec3 seen(vec3 albedo) {
  vec3 direct = light.sun.rgb * (world_sun.w * sunlit_small(world_sun.xyz, 0.06));
  return through_air(albedo * (direct + ambient), world_sun.xyz);
}
#endif

void main() {
#if defined(ALPHA_TEST) || !defined(IDS_ONLY)
  vec4 texel = texture(textures, vec3(uv, float(surface.x)));
#endif
#ifdef ALPHA_TEST
  if (texel.a < 0.5) discard;
#endif
#ifndef IDS_ONLY
  vec3 albedo = texel.rgb * linear_from_srgb(unpackUnorm4x8(surface.y).rgb);
  if (surface.w != 0u) {
    vec4 shades = texture(textures, vec3(uv, float(surface.w)));
    for (int i = 0; i < 4; ++i) {
      albedo += shades[i] * linear_from_srgb(unpackUnorm4x8(shaded[i]).rgb);
    }
  }
  color = vec4(film(seen(albedo)), 1.0);
#endif
  instance = surface.z;
  leave_silhouette();
}
