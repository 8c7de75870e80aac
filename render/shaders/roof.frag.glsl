// A flat roof: gravel on felt in strips, behind a parapet.
in vec3 world;
in vec3 ambient;
in vec4 local;  // from a corner of the roof's bounds, then their size; m
flat in vec3 normal;
flat in uint id;
flat in float facade_kind;  // of the walls below; 8: a hedge, whose top this is

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

void main() {
  vec2 p = local.xy;
  vec2 width = fwidth(p);
  float rim = min(min(p.x, local.z - p.x), min(p.y, local.w - p.y));
  float rim_width = max(width.x, width.y);
  float parapet = 1.0 - band(rim, 0.4, 1e4, rim_width);
  float gutter = band(rim, 0.4, 0.75, rim_width);
  float tone = hash(ivec2(int(id & 0xFFFFu), 17));
  float gravel = (noise(p * 11.0) - 0.5) * clamp(1.5 - 8.0 * rim_width, 0.0, 1.0);
  float stain = noise(p * 0.35) + 0.5 * noise(p * 1.4 + 9.0) - 0.75;
  float seam = stripes(p.x / 2.0, 0.02, width.x / 2.0);
  vec3 albedo = mix(vec3(0.27, 0.26, 0.25), vec3(0.36, 0.33, 0.29), tone);
  albedo *= (1.0 + 0.2 * gravel + 0.25 * stain) * (1.0 - 0.3 * seam) * (1.0 - 0.3 * gutter);
  albedo = mix(albedo, vec3(0.46, 0.44, 0.40), parapet);
  if (facade_kind > 7.5) albedo = vec3(0.020, 0.036, 0.011) * (0.6 + 0.8 * noise(p * 3.1));
#ifdef WET
  albedo *= 0.6;
#endif
  float sun = light.sun_direction.z * sunlit(world, 0.1);
  vec3 received = light.sun.rgb * sun + ambient;
#ifdef FIRES
  received += fire_light(world, vec3(0.0, 0.0, 1.0));
#endif
  vec3 radiance = albedo * received;
  color = vec4(film(through_air(radiance, world)), 1.0);
  instance = id;
}
