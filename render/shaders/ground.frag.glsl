// Ground of one material: with TEXTURED from its texture (render/ground/ground_texture.h), else
// ground_albedo comes from a ground_*.glsl: with STRIP in coordinates along and across a strip, with
// DECAL in those of a decal, whose opacity it sets.
in vec3 world;
in vec3 ambient;
in vec4 local;  // x: how bright the ground is here, compared with the material's mean; others: see SceneryVertex
flat in vec3 normal;
flat in uint id;

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

#ifdef WET
// A film of water: wet ground is darker (Lekner and Dorf 1988), and what it reflects shows the more
// the flatter one looks (Fresnel's law in Schlick's form, 1994). Puddles are mirrors with rings of
// drops in them.
vec3 wet(vec3 radiance, float sky_share) {
  vec2 p = world.xy;
  vec3 to_eye = light.eye.xyz - world;
  float distance_m = length(to_eye);
  float lie = noise(p * 0.23 + 40.0) + 0.35 * noise(p * 1.1 + 3.0);
#ifdef NO_PUDDLES
  // Water seeps away between blades of grass, which mirror little.
  float cosine_dry = clamp(to_eye.z / distance_m, 0.0, 1.0);
  vec3 sheen = mix(light.haze.rgb, light.zenith.rgb, cosine_dry) * (0.35 + 0.65 * sky_share);
  return radiance * 0.68 + sheen * (0.02 + 0.10 * pow(1.0 - cosine_dry, 5.0));
#endif
  float puddle = smoothstep(0.80, 0.88, lie);
  vec2 cell = floor(p * 4.0);
  float ring = fract(light.eye.w * 1.7 + hash(ivec2(cell)));
  float r = length(fract(p * 4.0) - 0.5);
  float ripple = sin(40.0 * (r - 0.5 * ring)) * smoothstep(0.1, 0.0, abs(r - 0.5 * ring));
  ripple *= clamp(1.0 - distance_m / 45.0, 0.0, 1.0);
  float cosine = clamp(to_eye.z / distance_m + 0.25 * ripple * puddle, 0.0, 1.0);
  float fresnel = 0.02 + 0.98 * pow(1.0 - cosine, 5.0);
  vec3 mirrored = mix(light.haze.rgb, light.zenith.rgb, cosine) * (0.35 + 0.65 * sky_share);
#ifdef LAMPS
  // Mirror images of lamps, drawn out by ripples.
  mirrored += 0.35 * ambient * ambient / max(light.lamps.rgb, 1e-6);
#endif
  vec3 dark = radiance * mix(0.52, 0.30, puddle);
  return dark + mirrored * fresnel * mix(0.8, 1.8, puddle);
}
#endif

#ifdef TEXTURED
layout(binding = 3) uniform sampler2D material;

const float kGroundTileM = 14.4;

vec3 ground_albedo(vec2 p, vec2 width) {
  vec3 root = texture(material, p * (1.0 / kGroundTileM)).rgb;
#ifdef EDGE_ALBEDO
  // The same texture in another size and direction, in patches that the brighter of both win.
  const mat2 kTurned = 1.37 * mat2(0.7986, 0.6018, -0.6018, 0.7986);
  vec3 other = texture(material, kTurned * p * (1.0 / kGroundTileM) + 0.37).rgb;
  float share = smoothstep(0.93, 1.07, local.x + 0.7 * (other.g - root.g));
  float ragged_m = noise(p * 1.3) * noise(p * 0.37 + 9.0) + 0.8 * (other.g - root.g);
  float edge = step(0.5, local.y) * smoothstep(0.08, -0.08, local.y - 1.05 - 1.3 * ragged_m);
  root = mix(root, other, share);
  return mix(root * root, EDGE_ALBEDO * (0.6 + root.g), 0.9 * edge);
#else
  return root * root;
#endif
}
#endif

#ifdef DECAL
flat in float facade_kind;
float opacity = 1.0;

vec3 ground_albedo(vec2 p, vec2 width);
#endif

// A surface of this albedo in its light, as the camera sees it.
vec3 seen_color(vec3 albedo) {
#ifdef FIRES
  float burned = charred(world, 0.7 * noise(world.xy * 0.9) + 0.3 * noise(world.xy * 3.7));
  albedo = charcoal(albedo, burned);
#endif
  vec3 received = ambient;
#ifndef NO_SUN
  received += light.sun.rgb * (max(dot(normal, light.sun_direction.xyz), 0.0) * sunlit(world, 0.02));
#endif
#ifdef FIRES
  received += fire_light(world, vec3(0.0, 0.0, 1.0));
#endif
  vec3 radiance = albedo * received;
#ifdef FIRES
  radiance += embers(world, burned, 0.6 * noise(world.xy * 2.9) + 0.4 * noise(world.xy * 8.3 + 5.0));
#endif
#ifdef WET
  radiance = wet(radiance, min(ambient.g / max(light.sky.g, 1e-6), 1.0));
#endif
  return film(through_air(radiance, world));
}

void main() {
#if defined(STRIP) || defined(DECAL)
  vec2 p = local.zw;
#else
  vec2 p = world.xy;
#endif
  // Worn and dirty ground is not only darker, but browner.
  vec3 albedo = ground_albedo(p, fwidth(p)) * (1.0 + (local.x - 1.0) * vec3(0.88, 1.0, 1.2));
#if defined(DARKENS)
  color = vec4(0.0, 0.0, 0.0, 0.55 * opacity);
#elif defined(DECAL)
  color = vec4(seen_color(albedo), opacity);
#else
  color = vec4(seen_color(albedo), 1.0);
#endif
  instance = id;
}
