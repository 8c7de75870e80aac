// Sun, sky, shadows and the film that they fall on; filled by render/scenery/lighting.cpp.
const int kMaxFires = 4;  // also in render/scenery/lighting.h

layout(std140, binding = 1) uniform Light {
  vec4 sun_direction;  // toward the sun
  vec4 sun;            // radiance of a white surface that faces it
  vec4 sky;            // the same under open sky, no sun; w: the radiance that is shown as black
  vec4 bounce;         // light that comes back from the ground
  vec4 haze;           // color of far air; w: its thickness, in powers of two per meter
  vec4 shadow_area;    // corner of the shadow map on the ground, then 1 / size (1/m)
  // Shadow of height 1 m on the ground is at -xy; z: 1 / tallest object (1/m); w: half the width,
  // m, of the sun's disc on the ground across that direction, seen through a hole 1 m high.
  vec4 shadow_slope;
  vec4 zenith;         // color of the sky above; w: what the camera's metering makes of all light
  vec4 lamps;          // radiance of a white surface in one unit of lamp light
  vec4 eye;            // the camera's center; w: time, s
  vec4 fires[kMaxFires];  // position on the ground, reach (m), light on a white surface in 1 m
} light;

layout(binding = 1) uniform sampler2DShadow shadow_map;

// Position in the shadow map of a point projected to the ground along the sun's rays.
vec2 shadow_uv(vec3 world) {
  vec2 on_ground = world.xy - light.shadow_slope.xy * world.z;
  return (on_ground - light.shadow_area.xy) * light.shadow_area.zw;
}

#if defined(NO_SUN)
float sunlit(vec3 world, float bias_m) { return 0.0; }
float sunlit_small(vec3 world, float bias_m) { return 0.0; }
#else
// How much of the sun reaches a point, from the nearest 2 x 2 texels.
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
// The same heights, without comparison; above the ground as a share of the tallest object.
layout(binding = 4) uniform sampler2D shadow_heights;

const float kWidestPenumbra = 1.0;  // m

// Places spread evenly over a disc of radius 1 (Vogel 1979), four texels each.
const int kLooks = 3;
const vec2 kOnDisc[kLooks] = vec2[](vec2(0.408, 0.000), vec2(-0.521, 0.478), vec2(0.080, -0.909));

// How much of the sun's disc reaches a point: edges are the softer the higher what casts them is
// above it (percentage-closer soft shadows, Fernando 2005). The disc on the ground is an ellipse,
// longer along the shadow.
float sunlit(vec3 world, float bias_m) {
  float height = (world.z + bias_m) * light.shadow_slope.z;
  vec2 uv = shadow_uv(world);
  vec2 along = light.shadow_slope.xy;
  float slope = max(length(along), 1e-4);
  along /= slope;
  float across_m = light.shadow_slope.w;
  mat2 disc = mat2(along / light.sun_direction.z, vec2(-along.y, along.x));
  // A turn of its own for each 2 x 2 fragments turns bands into grain; within them the places lie
  // between each other's.
  uvec2 fragment = uvec2(gl_FragCoord.xy);
  uint bits = (fragment.x >> 1) * 1597334673u ^ (fragment.y >> 1) * 3812015801u;
  bits = (bits ^ bits >> 15) * 2246822519u;
  float among = float((fragment.x & 1u) + 2u * (fragment.y & 1u));
  float turn = 6.2831853 * (float(bits >> 8) * (1.0 / 16777216.0) + among / float(4 * kLooks));
  disc *= 0.85 + 0.1 * among;
  disc *= mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  disc = mat2(disc[0] * light.shadow_area.zw, disc[1] * light.shadow_area.zw);
  float widest_m = min(across_m * (1.0 / light.shadow_slope.z - world.z), kWidestPenumbra);
  float sum = 0.0;
  float count = 0.0;
  for (int i = 0; i < kLooks; ++i) {
    vec4 above = textureGather(shadow_heights, uv + disc * kOnDisc[i] * widest_m) - height;
    sum += dot(max(above, 0.0), vec4(1.0));
    count += dot(vec4(greaterThan(above, vec4(0.0))), vec4(1.0));
  }
  // Most pixels have nothing above them and skip the second loop.
  bool shaded = count > 0.0;
  float penumbra_m = min(across_m * sum / (max(count, 1.0) * light.shadow_slope.z), kWidestPenumbra);
  // Never less than a texel, or the map's squares would show.
  float texel_m = 1.0 / (light.shadow_area.z * float(textureSize(shadow_map, 0).x));
  penumbra_m = max(penumbra_m, texel_m);
  float lit = 0.0;
  for (int i = shaded ? 0 : kLooks; i < kLooks; ++i) {
    vec4 seen = textureGather(shadow_heights, uv + disc * kOnDisc[i] * penumbra_m);
    lit += dot(step(seen, vec4(height)), vec4(1.0));
  }
  return shaded ? lit / float(4 * kLooks) : sunlit_small(world, bias_m);
}
#elif defined(WIDE_FILTER)
// How much of the sun reaches a point of a wall, or of the ground when the sun is low and the map's
// texels are large: from the nearest 4 x 4 texels, a tent of two texels to each side.
float sunlit(vec3 world, float bias_m) {
  vec2 size = vec2(textureSize(shadow_map, 0));
  vec2 texel = shadow_uv(world) * size - 0.5;
  vec2 first = floor(texel);
  vec2 f = texel - first;
  float height = (world.z + bias_m) * light.shadow_slope.z;
  // Columns and rows -1 and 0, then 1 and 2.
  vec4 weight_x = vec4(1.0 - f.x, 2.0 - f.x, 1.0 + f.x, f.x);
  vec4 weight_y = vec4(1.0 - f.y, 2.0 - f.y, 1.0 + f.y, f.y);
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2(float(i & 1), float(i >> 1)) * 2.0;
    vec4 a = textureGather(shadow_map, (first + corner) / size, height);
    vec2 wx = (i & 1) == 0 ? weight_x.xy : weight_x.zw;
    vec2 wy = i < 2 ? weight_y.xy : weight_y.zw;
    sum += wy.x * (a.w * wx.x + a.z * wx.y) + wy.y * (a.x * wx.x + a.y * wx.y);
  }
  return sum * (1.0 / 16.0);
}
#else
float sunlit(vec3 world, float bias_m) { return sunlit_small(world, bias_m); }
#endif
#endif

#ifdef FIRES
// Light of the fires on a surface.
vec3 fire_light(vec3 world, vec3 normal) {
  const vec3 kHue = vec3(1.45, 0.85, 0.36);
  float sum = 0.0;
  for (int i = 0; i < kMaxFires; ++i) {
    float reach = light.fires[i].z;
    // The middle of the flames flickers by a tenth, and is as large as they are.
    float turn = light.eye.w * (11.0 + 3.0 * float(i));
    float flicker = 1.0 + 0.06 * sin(turn) + 0.05 * sin(2.3 * turn + 1.0);
    vec3 to_fire = vec3(light.fires[i].xy, 0.5 + 0.4 * reach) - world;
    float square = dot(to_fire, to_fire) + 0.15 * reach * reach;
    float facing = 0.2 + 0.8 * max(dot(normal, to_fire) * inversesqrt(square), 0.0);
    sum += light.fires[i].w * flicker * facing / square;
  }
  return kHue * sum;
}

// How burned a surface is, 0 to 1; `ragged` is noise in [0, 1].
float charred(vec3 world, float ragged) {
  float most = 0.0;
  for (int i = 0; i < kMaxFires; ++i) {
    float reach = light.fires[i].z;
    float away = length(world.xy - light.fires[i].xy) + 0.25 * max(world.z - 1.5 - reach, 0.0);
    float edge = reach * (0.6 + 0.6 * ragged);
    most = max(most, 1.0 - smoothstep(0.6 * edge, edge + 1e-3, away));
  }
  return most;
}

vec3 charcoal(vec3 albedo, float burned) { return mix(albedo, vec3(0.018, 0.017, 0.016), 0.94 * burned); }

// Light of embers on burned ground; `grain` is noise in [0, 1].
vec3 embers(vec3 world, float burned, float grain) {
  float burning = 0.0;
  for (int i = 0; i < kMaxFires; ++i) {
    float reach = light.fires[i].z;
    float near = 1.0 - smoothstep(0.3 * reach, 0.9 * reach + 1e-3, length(world.xy - light.fires[i].xy));
    burning = max(burning, near * step(1e-9, light.fires[i].w));
  }
  return vec3(2.6, 0.55, 0.06) * (burning * burned * smoothstep(0.62, 0.85, grain));
}
#endif

// A film's response, which contains the display's gamma: the rational fit by Hejl and
// Burgess-Dawson (2010), with a darker black and brighter shadows (0.004 and 0.5 there).
vec3 film_response(vec3 radiance) {
  vec3 x = max(radiance - light.sky.w, 0.0);
  return (x * (6.2 * x + 0.6)) / (x * (6.2 * x + 1.7) + 0.06);
}

// Linear radiance to sRGB. kWhite is the radiance that the display shows as white, so high that a
// sunlit white wall is at a lightness of about 95 and only glints are cut off.
vec3 film(vec3 radiance) {
  const float kWhite = 2.2;  // also in render/lens/metering.cpp
  return min(film_response(radiance * light.zenith.w) / film_response(vec3(kWhite)), 1.0);
}

// Air between the camera and a point: the light that it adds, and the share that it lets through
// (Beer's law). Droplets throw light forwards, so that a ray from
// below brings more of the ground's light than of the sky's: the share of a hemisphere that reaches
// the camera is integrated from Henyey and Greenstein's phase function (1941; g = 0.75, ground of
// albedo 0.25) and fitted within 0.04.
vec4 air_before(vec3 world) {
  vec3 way = light.eye.xyz - world;
  float distance_m = length(way);
  float down = max(way.z, 0.0) / distance_m;
  float passed = exp2(-distance_m * light.haze.w);
  return vec4(light.haze.rgb * ((1.0 - 0.54 * down * (2.0 - down)) * (1.0 - passed)), passed);
}

vec3 through_air(vec3 radiance, vec3 world) {
  vec4 air = air_before(world);
  return radiance * air.a + air.rgb;
}
