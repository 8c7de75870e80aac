// Sun, sky, shadows and the film that they fall on; filled by render/lighting.cpp.
layout(std140, binding = 1) uniform Light {
  vec4 sun_direction;  // towards the sun
  vec4 sun;            // radiance of a white surface that faces it
  vec4 sky;            // the same under open sky, no sun
  vec4 bounce;         // light that comes back from the ground
  vec4 haze;           // colour of far air; w: its thickness, in powers of two per metre
  vec4 shadow_area;    // corner of the shadow map on the ground, then 1 / size (1/m)
  vec4 shadow_slope;   // shadow of height 1 m on the ground is at -xy; z: 1 / tallest thing (1/m)
  vec4 zenith;         // colour of the sky above
  vec4 lamps;          // radiance of a white surface in one unit of lamp light
  vec4 lamp_area;      // corner of the lamp map on the ground, then 1 / size (1/m)
  vec4 eye;            // the camera's centre; w: time, s
} light;

layout(binding = 1) uniform sampler2DShadow shadow_map;

// Where a point's line to the sun meets the ground, in the shadow map.
vec2 shadow_uv(vec3 world) {
  vec2 on_ground = world.xy - light.shadow_slope.xy * world.z;
  return (on_ground - light.shadow_area.xy) * light.shadow_area.zw;
}

#if defined(NO_SUN)
float sunlit(vec3 world, float bias_m) { return 0.0; }
float sunlit_small(vec3 world, float bias_m) { return 0.0; }
#else
// How much of the sun reaches a point, from 3 x 3 texels with bilinear weights.
float sunlit_sharp(vec3 world, float bias_m) {
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

#ifdef SOFT
// How much of a wide light above reaches a point: eight look-ups within 0.9 m.
float sunlit(vec3 world, float bias_m) {
  const vec2 kNear[4] = vec2[](vec2(0.3, 0.1), vec2(-0.1, 0.3), vec2(-0.3, -0.1), vec2(0.1, -0.3));
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    sum += sunlit_small(world + vec3(kNear[i], 0.0), bias_m);
    sum += sunlit_small(world + vec3(2.6 * kNear[i].yx, 0.0), bias_m);
  }
  return sum * 0.125;
}
#elif defined(FINE_SHADOWS)
float sunlit(vec3 world, float bias_m) { return sunlit_sharp(world, bias_m); }
#else
float sunlit(vec3 world, float bias_m) { return sunlit_small(world, bias_m); }
#endif
#endif

#ifdef LAMPS
layout(binding = 2) uniform sampler2D lamp_map;

// What the lamps give to a surface, in units of lamp light. The map holds, 1 m above the ground, the
// sum of the light's directions times its strengths, and of its strengths. Lamps shine downwards.
float lamp_light(vec3 world, vec3 normal) {
  vec4 seen = texture(lamp_map, (world.xy - light.lamp_area.xy) * light.lamp_area.zw);
  // What comes back from the ground and the walls reaches every side.
  float facing = max(dot(seen.xyz, normal), 0.0) + 0.25 * max(seen.w - length(seen.xyz), 0.0) +
                 0.16 * seen.w;
  return facing * clamp(2.6 - 0.5 * world.z, 0.0, 1.0);
}
#endif

// Linear radiance to sRGB: the rational fit of a film's response by Hejl and Burgess-Dawson (2010),
// which contains the display's gamma.
vec3 film(vec3 radiance) {
  vec3 x = max(radiance - 0.004, 0.0);
  return (x * (6.2 * x + 0.5)) / (x * (6.2 * x + 1.7) + 0.06);
}

// Air between the camera and a surface at depth z: Beer's law.
vec3 through_air(vec3 radiance, float z) {
  return mix(light.haze.rgb, radiance, exp2(-z * light.haze.w));
}
