// The land around the scenario, seen past its edge: fields with furrows, meadows, hedges along them,
// farm tracks, and gardens. Up to kFarM away houses and trees stand on it (render/scenery/far_land.h),
// for which render/scenery/land_pattern.cpp has the same fields; beyond, their roofs are painted.
const float kFieldM = 130.0;
const float kFarM = 900.0;

uniform vec4 place;         // lowest and highest corner of the scenario's ground
uniform float built_share;  // of the fields

// One field's color.
vec3 field_albedo(float kind) {
  if (kind < 0.3) return vec3(0.115, 0.15, 0.055);
  if (kind < 0.55) return vec3(0.155, 0.165, 0.07);
  if (kind < 0.75) return vec3(0.25, 0.215, 0.13);
  return kind < 0.88 ? vec3(0.175, 0.14, 0.10) : vec3(0.09, 0.125, 0.045);
}

vec3 ground_albedo(vec2 p, vec2 width) {
  float w = max(width.x, width.y);
  const vec3 kMean = vec3(0.155, 0.16, 0.08);
  if (w > 120.0) return kMean;
  vec2 q = mat2(0.94, 0.34, -0.34, 0.94) * p + 9.0 * vec2(noise(p * 0.011), noise(p * 0.011 + 31.0));
  float row = floor(q.y / kFieldM);
  float size = kFieldM * (0.8 + 0.9 * hash(ivec2(int(row), 3)));
  float along = q.x / size + 7.0 * hash(ivec2(int(row), 17));
  ivec2 field = ivec2(int(floor(along)), int(row));
  float kind = hash(field);
  vec3 albedo = field_albedo(kind);
  // Furrows, and patches where more or less grows.
  float furrows = stripes(q.y / 4.0, 0.5, width.y / 4.0) - 0.5;
  albedo *= 1.0 + 0.16 * furrows * step(0.3, kind) + 0.3 * (noise(q * 0.045) - 0.5);
  float grain = (noise(q * 0.6) - 0.5) * clamp(1.5 - 0.5 * w, 0.0, 1.0);
  albedo *= 1.0 + 0.25 * grain;
  vec2 off = max(max(place.xy - p, p - place.zw), 0.0);
  // Houses in their gardens instead of some fields.
  vec2 plot = q / vec2(26.0, 34.0);
  float built = step(1.0 - built_share, hash(field + 91));
  float garden = noise(q * 0.2);
  vec3 village = mix(vec3(0.10, 0.13, 0.05), vec3(0.17, 0.18, 0.09), garden);
  vec2 in_plot = fract(plot);
  village = mix(village, vec3(0.07, 0.095, 0.036), smoothstep(0.5, 0.8, noise(q * 0.13 + 50.0)));
  village *= 1.0 + 0.4 * grain;
  float roof = band(in_plot.x, 0.28, 0.72, width.x / 26.0) * band(in_plot.y, 0.3, 0.62, width.y / 34.0) *
               step(hash(ivec2(floor(plot)) + 5), 0.75) * step(kFarM, length(off));
  float red = hash(ivec2(floor(plot)) + 11);
  vec3 tiles = mix(vec3(0.23, 0.12, 0.085), vec3(0.17, 0.165, 0.16), step(0.55, red));
  village = mix(village, tiles * (0.8 + 0.4 * step(0.46, in_plot.y)), roof);
  village = mix(village, vec3(0.19, 0.185, 0.18), band(in_plot.y, 0.86, 1.0, width.y / 34.0));
  albedo = mix(albedo, village, built);
  // Hedges and tracks between the fields.
  vec2 border = vec2(fract(along) * size, fract(q.y / kFieldM) * kFieldM);
  float ragged = 3.0 * noise(q * 0.22);
  float hedge = max(band(border.x, 0.0, 4.0 + ragged, width.x), band(border.y, 0.0, 3.0 + ragged, width.y) *
                                                                    step(0.4, hash(ivec2(int(row), 29))));
  albedo = mix(albedo, vec3(0.05, 0.075, 0.03) * (0.7 + 0.6 * noise(q * 0.35)), 0.9 * hedge);
  float track = band(border.y, 8.0, 11.5, width.y) * step(hash(ivec2(int(row), 41)), 0.5);
  albedo = mix(albedo, vec3(0.24, 0.215, 0.17), track);
  // A strip of rough grass and bushes around the place, which no straight line ends.
  float outside_m = length(off) + 16.0 * (noise(p * 0.07) - 0.5) + 5.0 * (noise(p * 0.4) - 0.5);
  vec3 rough = mix(vec3(0.105, 0.13, 0.05), vec3(0.17, 0.165, 0.085), noise(p * 0.16));
  rough *= 1.0 + 0.35 * (noise(p * 1.7) - 0.5) * clamp(1.5 - w, 0.0, 1.0);
  rough = mix(rough, vec3(0.08, 0.105, 0.04), 0.7 * smoothstep(0.5, 0.85, noise(p * 0.21 + 20.0)));
  rough *= 1.0 + 0.4 * grain;
  albedo = mix(rough, albedo, smoothstep(26.0, 30.0, outside_m));
  return mix(albedo, kMean, smoothstep(40.0, 120.0, w));
}
