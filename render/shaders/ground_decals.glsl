// Traces of use on the ground; the kinds are those of DecalKind (render/ground/ground_decals.h). With
// DARKENS those that have no color of their own, with SMALL fields of small objects, else the others.
const int kManhole = 0;
const int kDrain = 1;
const int kPatch = 2;
const int kSlabs = 3;
const int kChalk = 4;
const int kSigns = 5;
const int kStain = 6;
const int kTires = 7;
const int kTracks = 8;
const int kSoil = 9;
const int kWet = 10;
const int kShade = 11;
const int kLine = 12;
const int kLeaves = 13;  // and what follows: small objects

const float kFarM = 120.0;

// Small objects, one in a share of the cells of a grid: the cells' size (m), their share, least and
// most half length (m).
const vec4 kObjects[5] = vec4[](vec4(0.13, 0.50, 0.026, 0.058), vec4(0.42, 0.42, 0.015, 0.075),
                               vec4(0.17, 0.40, 0.010, 0.026), vec4(0.16, 0.50, 0.012, 0.026),
                               vec4(0.24, 0.75, 0.035, 0.11));
const vec3 kHues[10] = vec3[](vec3(0.16, 0.095, 0.045), vec3(0.25, 0.18, 0.08),  // leaves
                              vec3(0.60, 0.58, 0.54), vec3(0.24, 0.19, 0.15),   // paper, cups, butts
                              vec3(0.10, 0.10, 0.095), vec3(0.30, 0.29, 0.27),  // chewing gum
                              vec3(0.62, 0.62, 0.56), vec3(0.55, 0.48, 0.08),   // daisies, dandelions
                              vec3(0.06, 0.09, 0.03), vec3(0.12, 0.15, 0.05));  // weeds

// Sets the opacity of small objects around the middle of a decal; returns their color.
vec3 small_objects(int kind, vec2 p, float dense, float w, ivec2 seed) {
  vec4 object = kObjects[kind - kLeaves];
  ivec2 cell = ivec2(floor(p / object.x)) + seed;
  float size = hash(cell + 7);
  float half_m = mix(object.z, object.w, size * size);
  vec2 off = fract(p / object.x) * object.x - half_m - (object.x - 2.0 * half_m) * vec2(hash(cell + 11), hash(cell + 13));
  float turn = 6.2832 * hash(cell + 17);
  off = mat2(cos(turn), sin(turn), -sin(turn), cos(turn)) * off;
  off.y *= 1.0 + 0.9 * hash(cell + 23);
  float is_there = step(hash(cell + 19), object.y * dense);
  opacity = is_there * clamp((half_m - length(off)) / w + 0.5, 0.0, 1.0) * min(2.0 * half_m / w, 1.0);
  float hue = hash(cell + 29);
  return mix(kHues[2 * (kind - kLeaves)], kHues[2 * (kind - kLeaves) + 1], hue) * (0.75 + 0.5 * size);
}

// A cast cover in its frame.
vec3 cover(vec2 p, vec2 width) {
  float r = length(p);
  float w = max(width.x, width.y);
  opacity = clamp((0.325 - r) / w + 0.5, 0.0, 1.0);
  vec2 ribs = stripes_xy(p / 0.06, 0.45, width / 0.06);
  vec3 iron = vec3(0.135, 0.125, 0.115) * (0.72 + 0.5 * abs(ribs.x - ribs.y) * step(r, 0.23));
  iron = mix(iron, vec3(0.22, 0.21, 0.195), band(r, 0.285, 0.325, w));
  return iron * (1.0 - 0.7 * band(r, 0.262, 0.282, w)) * (0.8 + 0.4 * noise(p * 9.0));
}

vec3 grating(vec2 p, vec2 half_size, vec2 width) {
  vec2 inside = half_size - abs(p);
  float rim = min(inside.x, inside.y);
  opacity = clamp(rim / max(width.x, width.y) + 0.5, 0.0, 1.0);
  float slot = stripes(p.x / 0.05, 0.55, width.x / 0.05) * band(rim, 0.035, 9.0, max(width.x, width.y));
  return mix(vec3(0.15, 0.14, 0.13), vec3(0.015), slot);
}

// Asphalt laid later than what is around it, sealed along its seams.
vec3 repair(vec2 p, vec2 half_size, float w, float pick, float rough) {
  vec2 inside = half_size - abs(p) - 0.03 * rough;
  float rim = min(inside.x, inside.y);
  opacity = 0.9 * clamp(rim / max(w, 0.01) + 0.5, 0.0, 1.0);
  float grain = (noise(p * 45.0) - 0.5) * clamp(1.5 - 30.0 * w, 0.0, 1.0);
  vec3 albedo = mix(vec3(0.105, 0.104, 0.103), vec3(0.20, 0.196, 0.19), step(0.6, pick));
  return albedo * (1.0 + 0.5 * grain + 0.25 * (rough - 0.5)) * (1.0 - 0.55 * band(rim, -1.0, 0.05, w));
}

// Squares for hopscotch, single and in pairs.
vec3 chalk(vec2 p, vec2 half_size, float w, float pick, float rough) {
  float side = 0.4;
  float row = floor((p.x + half_size.x) / side);
  float wide = mod(row, 3.0) == 2.0 ? side : 0.5 * side;
  vec2 in_row = vec2(abs(fract((p.x + half_size.x) / side + 0.5) - 0.5) * side, abs(abs(p.y) - wide));
  float line = min(abs(p.y) < wide ? in_row.x : 1.0, in_row.y);
  if (mod(row, 3.0) == 2.0) line = min(line, abs(p.y));
  opacity = clamp((0.022 - line) / w + 0.5, 0.0, 1.0) * min(0.045 / w, 1.0) * smoothstep(0.1, 0.6, rough) * 0.75;
  return mix(vec3(0.70, 0.68, 0.66), pick < 0.5 ? vec3(0.62, 0.35, 0.40) : vec3(0.35, 0.48, 0.65), step(0.3, pick));
}

// An arrow and a stroke across it.
vec3 sprayed(vec2 p, vec2 half_size, float w, float pick) {
  vec2 q = abs(p);
  float shaft = max(q.y, q.x - 0.85 * half_size.x);
  float head = max(abs(q.y - 0.6 * (0.85 * half_size.x - p.x)), abs(p.x - 0.65 * half_size.x) - 0.2 * half_size.x);
  opacity = 0.6 * clamp((0.025 - min(shaft, head)) / max(w, 0.02) + 0.5, 0.0, 1.0) * min(0.05 / w, 1.0);
  return pick < 0.5 ? vec3(0.62, 0.20, 0.05) : pick < 0.8 ? vec3(0.10, 0.22, 0.50) : vec3(0.6, 0.58, 0.56);
}

vec3 ground_albedo(vec2 p, vec2 width) {
  int kind = int(facade_kind);
  vec2 half_size = local.y * vec2(1.0, fract(facade_kind) / 0.999);
  ivec2 seed = ivec2(id & 0xFFFFu, id >> 16);
  float pick = hash(seed);
  float w = max(width.x, width.y);
  vec2 at = abs(p) / half_size;
  float away = length(at);  // 1 on the rim of the ellipse in it
  vec3 albedo = vec3(0.0);
#if defined(SMALL)
  float dense = clamp(1.15 - away * away, 0.0, 1.0) * smoothstep(0.25, 0.75, noise(p * 2.1 + vec2(seed & 1023)));
  albedo = small_objects(kind, p, 1.5 * dense, w, seed);
  opacity *= step(away, 1.0) * step(w, 0.08);
#else
  float rough = 0.65 * noise(p * 2.1 + vec2(seed & 1023)) + 0.35 * noise(p * 7.0 + vec2(seed & 511));
#if defined(DARKENS)
  if (kind == kStain) {
    opacity = (0.12 + 0.22 * pick) * smoothstep(1.0, 0.35, away + 0.9 * (rough - 0.4));
  } else if (kind == kTires) {
    float wheel = abs(abs(p.y) - max(half_size.y - 0.12, 0.0));
    opacity = 0.4 * smoothstep(0.12, 0.06, wheel) * smoothstep(1.0, 0.6, at.x) * smoothstep(0.2, 0.6, rough);
  } else if (kind == kTracks) {
    float wheel = (abs(p.y) - 0.75) / 0.26;
    float oil = p.y / 0.22;
    float along = noise(world.xy * 0.12) + 0.5;
    opacity = along * (0.15 * exp(-wheel * wheel) + 0.09 * exp(-oil * oil)) * (0.7 + 0.6 * rough);
  } else if (kind == kWet) {
    opacity = 0.32 * smoothstep(1.0, 0.35, away + 0.7 * (rough - 0.4));
  } else {
    opacity = 0.5 * max(1.0 - at.y, 0.0);
  }
#else
  if (kind == kManhole) albedo = cover(p, width);
  if (kind == kDrain) albedo = grating(p, half_size, width);
  if (kind == kPatch) albedo = repair(p, half_size, w, pick, rough);
  if (kind == kSlabs) {
    float rim = min(half_size.x - abs(p.x), half_size.y - abs(p.y));
    float seam = band(rim, -1.0, 0.03, w);
    opacity = (0.10 + 0.12 * pick + 0.25 * seam) * clamp(rim / w + 0.5, 0.0, 1.0);
    albedo = mix(pick < 0.6 ? vec3(0.13, 0.125, 0.12) : vec3(0.62, 0.58, 0.52), vec3(0.08), seam);
  }
  if (kind == kChalk) albedo = chalk(p, half_size, w, pick, rough);
  if (kind == kSigns) albedo = sprayed(p, half_size, w, pick);
  if (kind == kLine) {  // 0.12 m wide: also in render/ground/pitch.cpp
    opacity = clamp((0.06 - abs(p.y)) / width.y + 0.5, 0.0, 1.0) * min(0.12 / width.y, 1.0);
    albedo = vec3(0.6, 0.6, 0.57);
  }
  if (kind == kSoil) {
    float edge = max(at.y, max(at.x - 0.5, 0.0) * 2.0);
    opacity = 0.88 * smoothstep(1.0, 0.45, edge + 0.8 * (rough - 0.35));
    albedo = vec3(0.205, 0.165, 0.108) * (0.7 + 0.6 * noise(p * 16.0));
  }
#endif
#endif
  opacity *= smoothstep(kFarM, 0.75 * kFarM, length(light.eye.xyz - world));
  return albedo;
}
