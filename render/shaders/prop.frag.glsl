// Props; the finishes are those of render/props/prop_mesh.h. With LEAVES: cards with leaves on them and
// holes between. SHINY, BARK, WATER or SCREEN: those surfaces are among them.
in vec3 world;
in vec3 normal;
flat in vec4 paint;
flat in uint id;
in vec3 ambient;
#ifdef LEAVES
in vec3 card;
in float sunlit_share;
layout(binding = 5) uniform sampler2DArray leaf_sprites;  // cover and shade; render/props/leaf_sprites.h
#endif

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

const float kGlossy = 2.0;
const float kLamp = 3.0;
const float kLitGlass = 5.0;

vec3 sky_in(vec3 direction) {
  vec3 sky = mix(light.haze.rgb, light.zenith.rgb, sqrt(max(direction.z, 0.0)));
  return sky * (direction.z > 0.0 ? 1.0 : 0.25);
}

#ifdef WATER
// The slope of smooth noise with `per_meter` features per meter that drifts over the water.
vec2 drifting_slope(vec2 p, float per_meter, float turn, vec2 drift) {
  mat2 turned = mat2(cos(turn), sin(turn), -sin(turn), cos(turn));
  vec2 at = turned * p * per_meter + drift;
  const float kStep = 0.2;
  float here = noise(at);
  return vec2(noise(at + vec2(kStep, 0.0)) - here, noise(at + vec2(0.0, kStep)) - here) * turned / kStep;
}

// The slope of the water's surface: swell, waves and ripples.
vec2 wave_slope(vec2 p, float time_s, float distance_m) {
  vec2 slope = 0.05 * drifting_slope(p, 0.35, 0.4, time_s * vec2(0.25, 0.1)) +
               0.10 * drifting_slope(p, 1.1, 1.3, time_s * vec2(-0.5, 0.4));
  // Those finer than a pixel blur what they mirror.
  float seen = clamp(60.0 / distance_m, 0.0, 1.0);
  slope += 0.10 * seen * drifting_slope(p, 3.3, 2.5, time_s * vec2(0.9, -0.8));
  // Gusts roughen some parts, and leave others smooth.
  float gust = noise(vec2(0.05, 0.11) * p + time_s * vec2(0.05, 0.02)) + 0.5 * noise(0.21 * p.yx + 9.0);
  return slope * (0.4 + 0.7 * gust);
}
#endif

#ifdef BARK
// Furrows along a trunk; dark bands around a birch's, which is bright.
vec3 bark(vec3 albedo, vec3 n) {
  float around = abs(n.x) > abs(n.y) ? world.y : world.x;
  bool is_birch = albedo.r > 0.35;
  vec2 fine = vec2(around, world.z) * (is_birch ? vec2(5.0, 15.0) : vec2(34.0, 4.0));
  float furrows = noise(fine + 3.0) + 0.4 * noise(2.3 * fine);
  if (is_birch) {
    float band = smoothstep(0.88, 0.98, furrows + 0.25 * exp(-world.z));
    return mix(albedo, vec3(0.05, 0.045, 0.04), 0.85 * band);
  }
  return albedo * (0.45 + 0.8 * furrows);
}
#endif

void main() {
  vec3 albedo = paint.rgb;
  vec3 n = normalize(normal);
#ifndef LEAVES
  if (!gl_FrontFacing) n = -n;
  float finish = round(paint.a * 255.0);
#ifdef BARK
  albedo = bark(albedo, n);
#endif
#endif
#ifdef WET
  albedo *= 0.75;
#endif
#ifdef LEAVES
  vec2 leaf = texture(leaf_sprites, card).rg;
  if (leaf.r < 0.5) discard;
  albedo *= 2.0 * leaf.g;
  // Light goes through leaves and around their sides: the dark side is not black, and has no hard
  // border.
  float wrapped = 0.5 + 0.5 * dot(n, light.sun_direction.xyz);
  float facing = 0.12 + 0.88 * wrapped * wrapped;
  float shadow = sunlit_share;
#else
  float facing = max(dot(n, light.sun_direction.xyz), 0.0);
#ifdef NO_SHADOWS
  float shadow = 1.0;
#else
  float shadow = sunlit_small(world + 0.05 * n, 0.06);
#endif
#endif
  vec3 received = ambient + light.sun.rgb * (facing * shadow);
#ifdef FIRES
  albedo = charcoal(albedo, charred(world, 0.5));
  received += fire_light(world, n);
#endif
  vec3 radiance = albedo * received;
#ifdef SHINY
  if (finish == kGlossy || finish == kLitGlass) {
    vec3 to_eye = normalize(light.eye.xyz - world);
    vec3 mirrored = reflect(-to_eye, n);
    float fresnel = 0.05 + 0.95 * pow(1.0 - max(dot(to_eye, n), 0.0), 5.0);
    float glint = pow(max(dot(mirrored, light.sun_direction.xyz), 0.0), 90.0);
    radiance += fresnel * sky_in(mirrored) + light.sun.rgb * (0.8 * glint * shadow);
  }
#endif
#ifdef WATER
  if (n.z > 0.5) {
    vec3 to_eye = light.eye.xyz - world;
    float distance_m = length(to_eye);
    to_eye /= distance_m;
    vec2 slope = wave_slope(world.xy, light.eye.w, distance_m);
    vec3 surface = normalize(vec3(-slope, 1.0));
    vec3 mirrored = reflect(-to_eye, surface);
    mirrored.z = abs(mirrored.z);
    float fresnel = 0.02 + 0.98 * pow(1.0 - max(dot(to_eye, surface), 0.0), 5.0);
    float glint = pow(max(dot(mirrored, light.sun_direction.xyz), 0.0), 220.0);
    // Little of the light that enters comes back; a shadow on it is faint.
    float through = max(dot(surface, light.sun_direction.xyz), 0.0) * (0.85 + 0.15 * shadow);
    vec3 inside = albedo * (ambient + light.sun.rgb * through);
    // The banks are mirrored below the sky, torn by the waves.
    vec3 banks = vec3(0.10, 0.12, 0.08) * (light.sky.rgb + 0.3 * light.sun.rgb);
    float bank_edge = 0.10 + 0.04 * sin(3.0 * atan(mirrored.y, mirrored.x));
    float above_banks = max(smoothstep(0.0, 2.0 * bank_edge, mirrored.z), smoothstep(0.12, 0.3, to_eye.z));
    vec3 beyond = mix(banks, sky_in(mirrored), 0.35 + 0.65 * above_banks);
    radiance = (1.0 - fresnel) * inside + fresnel * beyond +
               light.sun.rgb * (6.0 * glint * fresnel * shadow);
  }
#endif
#ifdef SCREEN
  vec2 place = vec2(world.x + world.y, world.z);
  vec3 shown = screen_image(0.14 * floor(place * 12.0) / 12.0, light.eye.w);
  // Cabinets half a meter wide differ a little, and have seams.
  vec2 cabinet = floor(place * 2.0);
  vec2 in_cabinet = fract(place * 2.0);
  float seam = step(0.015, min(min(in_cabinet.x, 1.0 - in_cabinet.x), min(in_cabinet.y, 1.0 - in_cabinet.y)));
  shown *= (0.97 + 0.05 * fract(dot(cabinet, vec2(0.37, 0.71)))) * (0.75 + 0.25 * seam);
  radiance += shown * (0.45 * light.sky.rgb + 0.12 * light.sun.rgb);
#ifdef LAMPS
  radiance += light.lamps.rgb * (8.0e-4 * shown);
#endif
#endif
#if defined(LAMPS) && !defined(LEAVES)
  if (finish == kLitGlass) radiance += light.lamps.rgb * vec3(2.2e-4, 1.9e-4, 1.4e-4);
  if (finish == kLamp) radiance += light.lamps.rgb * 2.5e-3;
#endif
  color = vec4(film(through_air(radiance, world)), 1.0);
  instance = id;
}
