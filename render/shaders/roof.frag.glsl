// A roof: gravel, felt or plants if flat; with LAPPED tiles or slates.
in vec3 world;
in vec3 ambient;
in vec4 local;  // along the eaves and up the slope; m
flat in vec3 normal;
flat in uint id;
flat in float facade_kind;  // world::Covering or render::RoofLook
flat in vec4 paint;

layout(location = 0) out vec4 color;
layout(location = 1) out uint instance;

const int kTiles = 2;
const int kMetal = 4;
const int kGrass = 5;
const int kFelt = 6;
const int kCoping = 7;
const int kHedge = 8;

#ifdef LAPPED
// Rows of tiles or slates, each with its own tone, lapped over the row below.
float lapped(vec2 p, vec2 size, vec2 width, float variety, float round_m) {
  float row = floor(p.y / size.y);
  vec2 at = vec2(p.x / size.x + 0.5 * mod(row, 2.0), p.y / size.y);
  vec2 at_width = width / size;
  float fade = clamp(1.6 - 1.6 * max(at_width.x, at_width.y), 0.0, 1.0);
  float tone = (hash(ivec2(floor(at))) - 0.5) * variety * fade;
  float shade = stripes(at.y + 0.5 * at_width.y, 0.16, at_width.y);
  float joint = stripes(at.x, 0.07, at_width.x);
  float bulge = round_m * (abs(fract(at.x) - 0.5) - 0.25) * fade;
  return 1.0 + tone - 0.34 * shade - 0.2 * joint - bulge;
}
#endif

void main() {
  int kind = int(facade_kind + 0.5);
  vec2 p = local.xy;
  vec2 width = fwidth(p);
  float stain = noise(p * 0.35) + 0.5 * noise(p * 1.4 + 9.0) - 0.75;
  vec3 albedo = paint.rgb;
#ifdef LAPPED
  bool tiles = kind == kTiles;
  vec2 size = tiles ? vec2(0.21, 0.30) : vec2(0.22, 0.17);
  albedo *= lapped(p, size, width, tiles ? 0.34 : 0.42, tiles ? 0.7 : 0.0);
  // Moss and soot from the foot up, patches of newer ones.
  float moss = smoothstep(0.45, 0.8, noise(p * 0.9 + 31.0) + 0.3 * noise(p * 3.0) - 0.12 * p.y);
  albedo = mix(albedo, vec3(0.075, 0.080, 0.042), 0.45 * moss);
  albedo *= 1.0 + 0.26 * stain;
#else
  // Ponds that have dried up on felt, tufts in grass, leaves in a hedge.
  float patches = noise(p * (kind == kFelt ? 0.28 : kind == kHedge ? 3.1 : 0.6) + 3.0);
  float fine = (noise(p * 11.0) - 0.5) * clamp(1.5 - 8.0 * max(width.x, width.y), 0.0, 1.0);
  if (kind == kMetal) {
    float seam = stripes(p.x / 0.53, 0.06, width.x / 0.53);
    float sheet = hash(ivec2(floor(vec2(p.x / 0.53, p.y / 4.0)))) - 0.5;
    albedo *= (1.0 - 0.4 * seam) * (1.0 + 0.12 * sheet + 0.16 * stain);
  } else if (kind == kGrass) {
    albedo *= 1.07 + 0.8 * stain + 0.35 * fine;
    albedo = mix(albedo, vec3(0.19, 0.095, 0.06), 0.5 * smoothstep(0.5, 0.75, patches));
  } else if (kind == kFelt) {
    float strip = hash(ivec2(int(floor(p.x)), int(floor(p.y / 7.0)))) - 0.5;
    float seam = max(stripes(p.x, 0.05, width.x), stripes(p.y / 7.0, 0.008, width.y / 7.0));
    float pond = smoothstep(0.62, 0.7, patches);
    albedo *= (1.0 + 0.14 * strip + 0.3 * stain) * (1.0 - 0.25 * seam) * (1.0 - 0.22 * pond);
    albedo *= 1.0 + 0.15 * fine;
  } else if (kind == kHedge) {
    albedo = vec3(0.020, 0.036, 0.011) * (0.6 + 0.8 * patches);
  } else {
    albedo *= 1.0 + (kind == kCoping ? 0.1 : 0.34) * fine + 0.3 * stain;
  }
#endif
#ifdef WET
  albedo *= 0.6;
#endif
  float facing = max(dot(normal, light.sun_direction.xyz), 0.0);
  float sun = facing * sunlit(world + 0.06 * normal, 0.1);
  vec3 received = light.sun.rgb * sun + ambient;
#ifdef FIRES
  received += fire_light(world, normal);
#endif
  vec3 radiance = albedo * received;
  color = vec4(film(through_air(radiance, world)), 1.0);
  instance = id;
}
