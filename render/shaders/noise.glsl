// Repeatable irregularity: every value depends on world coordinates alone.

float hash(ivec2 cell) {
  uvec2 q = uvec2(cell) * uvec2(1597334673u, 3812015801u);
  uint h = (q.x ^ q.y) * 1597334673u;
  h ^= h >> 15;
  h *= 2246822519u;
  return float(h >> 8) * (1.0 / 16777216.0);
}

// Smooth noise in [0, 1], one feature per unit.
float noise(vec2 p) {
  ivec2 cell = ivec2(floor(p));
  vec2 f = fract(p);
  f = f * f * (3.0 - 2.0 * f);
  float low = mix(hash(cell), hash(cell + ivec2(1, 0)), f.x);
  float high = mix(hash(cell + ivec2(0, 1)), hash(cell + ivec2(1, 1)), f.x);
  return mix(low, high, f.y);
}

// How much of a footprint of size `width` around x lies on stripes [k, k + share), k integer:
// exact, so stripes finer than a pixel fade to their mean instead of flickering.
float stripes(float x, float share, float width) {
  vec2 ends = vec2(x - 0.5 * width, x + 0.5 * width);
  vec2 area = floor(ends) * share + min(fract(ends), share);
  return (area.y - area.x) / max(width, 1e-6);
}

vec2 stripes_xy(vec2 x, float share, vec2 width) {
  return vec2(stripes(x.x, share, width.x), stripes(x.y, share, width.y));
}

// How much of a footprint of size `width` around x lies in [low, high].
float band(float x, float low, float high, float width) {
  float w = max(width, 1e-6);
  return clamp((min(x + 0.5 * w, high) - max(x - 0.5 * w, low)) / w, 0.0, 1.0);
}
