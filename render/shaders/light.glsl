// Sun, sky, shadows and the film that they fall on; filled by render/lighting.cpp.
layout(std140, binding = 1) uniform Light {
  vec4 sun_direction;  // towards the sun
  vec4 sun;            // radiance of a white surface that faces it
  vec4 sky;            // the same under open sky, no sun
  vec4 bounce;         // light that comes back from the ground
  vec4 haze;           // colour of far air; w: per metre
  vec4 shadow_area;    // corner of the shadow map on the ground, then 1 / size (1/m)
  vec4 shadow_slope;   // shadow of height 1 m on the ground is at -xy; z: 1 / tallest thing (1/m)
} light;

layout(binding = 1) uniform sampler2DShadow shadow_map;

// Where a point's line to the sun meets the ground, in the shadow map.
vec2 shadow_uv(vec3 world) {
  vec2 on_ground = world.xy - light.shadow_slope.xy * world.z;
  return (on_ground - light.shadow_area.xy) * light.shadow_area.zw;
}

// How much of the sun reaches a point, from 3 x 3 texels with bilinear weights.
float sunlit(vec3 world, float bias_m) {
  vec2 size = vec2(textureSize(shadow_map, 0));
  float height = (world.z + bias_m) * light.shadow_slope.z;
  vec2 texel = shadow_uv(world) * size - 0.5;
  vec2 f = fract(texel);
  vec2 middle = (floor(texel) + 1.0) / size;  // corner shared by four texels
  vec4 a = textureGatherOffset(shadow_map, middle, height, ivec2(-1, -1));
  vec4 b = textureGatherOffset(shadow_map, middle, height, ivec2(1, -1));
  vec4 c = textureGatherOffset(shadow_map, middle, height, ivec2(-1, 1));
  vec4 d = textureGatherOffset(shadow_map, middle, height, ivec2(1, 1));
  // A gather returns the texels (0,1), (1,1), (1,0), (0,0) of its 2 x 2 block.
  vec2 g = 1.0 - f;
  float lower = (a.w * g.x + a.z + b.w + b.z * f.x) * g.y + (a.x * g.x + a.y + b.x + b.y * f.x);
  float upper = (c.w * g.x + c.z + d.w + d.z * f.x) + (c.x * g.x + c.y + d.x + d.y * f.x) * f.y;
  return (lower + upper) * (1.0 / 9.0);
}

// The same from the nearest 2 x 2 texels, for surfaces with little room for soft edges.
float sunlit_small(vec3 world, float bias_m) {
  vec2 size = vec2(textureSize(shadow_map, 0));
  vec2 texel = shadow_uv(world) * size - 0.5;
  vec2 f = fract(texel);
  vec4 a = textureGather(shadow_map, (floor(texel) + 1.0) / size,
                         (world.z + bias_m) * light.shadow_slope.z);
  return mix(mix(a.w, a.z, f.x), mix(a.x, a.y, f.x), f.y);
}

// Linear radiance to sRGB: the rational fit of a film's response by Hejl and Burgess-Dawson (2010),
// which contains the display's gamma.
vec3 film(vec3 radiance) {
  vec3 x = max(radiance - 0.004, 0.0);
  return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
}

// Air between the camera and a surface at depth z.
vec3 through_air(vec3 radiance, float z) {
  float thickness = z * light.haze.w;
  return mix(radiance, light.haze.rgb, thickness / (1.0 + thickness));
}
