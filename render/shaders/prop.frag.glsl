// Props; the finishes are those of render/props/prop_shapes.h. With LEAVES: cards with leaves on them and
// holes between.
in vec3 world;
in vec3 normal;
in vec2 card;
flat in vec4 paint;
flat in uint id;
flat in int card_number;

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

const float kGlossy = 2.0;
const float kLamp = 3.0;

vec3 sky_in(vec3 direction) {
  vec3 sky = mix(light.haze.rgb, light.zenith.rgb, sqrt(max(direction.z, 0.0)));
  return sky * (direction.z > 0.0 ? 1.0 : 0.25);
}

void main() {
  vec3 albedo = paint.rgb;
#ifdef WET
  albedo *= 0.75;
#endif
  vec3 n = normalize(normal);
#ifndef LEAVES
  if (!gl_FrontFacing) n = -n;
#endif
#ifdef LEAVES
  const float kTwigs = 6.0;
  ivec2 twig = ivec2(floor(card * kTwigs)) + ivec2(card_number * 11, 0);
  float pick = hash(twig);
  vec2 from_twig = fract(card * kTwigs) - 0.5 + 0.4 * vec2(pick - 0.5, hash(twig + 77) - 0.5);
  vec2 from_middle = card - 0.5;
  if (length(from_twig) > 0.62 - 0.5 * pick || dot(from_middle, from_middle) > 0.25) discard;
  albedo *= 0.75 + 0.5 * pick;
  // Light goes through leaves: their dark side is not black.
  float facing = 0.3 + 0.7 * max(dot(n, light.sun_direction.xyz), 0.0);
  float shadow_bias = 0.9;
#else
  float facing = max(dot(n, light.sun_direction.xyz), 0.0);
  float shadow_bias = 0.06;
#endif
#ifdef NO_SHADOWS
  float shadow = 1.0;
#else
  float shadow = sunlit_small(world + 0.05 * n, shadow_bias);
#endif
  vec3 received = mix(light.bounce.rgb, light.sky.rgb, 0.5 + 0.5 * n.z) +
                  light.sun.rgb * (facing * shadow);
#ifdef LAMPS
  received += light.lamps.rgb * lamp_light(world, n);
#endif
  vec3 radiance = albedo * received;
  float finish = round(paint.a * 255.0);
#ifndef LEAVES
  if (finish == kGlossy) {
    vec3 to_eye = normalize(light.eye.xyz - world);
    vec3 mirrored = reflect(-to_eye, n);
    float fresnel = 0.05 + 0.95 * pow(1.0 - max(dot(to_eye, n), 0.0), 5.0);
    float glint = pow(max(dot(mirrored, light.sun_direction.xyz), 0.0), 90.0);
    radiance += fresnel * sky_in(mirrored) + light.sun.rgb * (0.8 * glint * shadow);
  }
#endif
#ifdef LAMPS
  if (finish == kLamp) radiance += light.lamps.rgb * 2.5e-3;
#endif
  color = vec4(film(through_air(radiance, world)), 1.0);
  instance = id;
}
