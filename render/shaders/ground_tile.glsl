// Irregularity for the grounds, repeated with the tile that their textures hold. `salt`
// distinguishes patterns of one material apart.
const float kTileM = 14.4;  // also in render/scenery/ground_texture.h

ivec2 wrapped(ivec2 cell, ivec2 count) {
  return cell - count * ivec2(floor(vec2(cell) / vec2(count)));
}

// A number in [0, 1) for one of count.x x count.y cells of the tile.
float pick(ivec2 cell, ivec2 count, int salt) {
  return hash(wrapped(cell, count) + ivec2(salt * 131, salt * 57));
}

// Smooth noise in [0, 1], `per_metre` features per meter.
float grain(vec2 p, float per_meter, int salt) {
  ivec2 count = ivec2(int(per_meter * kTileM + 0.5));
  vec2 at = p * vec2(count) / kTileM;
  ivec2 cell = ivec2(floor(at));
  vec2 f = fract(at);
  f = f * f * (3.0 - 2.0 * f);
  float low = mix(pick(cell, count, salt), pick(cell + ivec2(1, 0), count, salt), f.x);
  float high = mix(pick(cell + ivec2(0, 1), count, salt), pick(cell + ivec2(1, 1), count, salt), f.x);
  return mix(low, high, f.y);
}

// Noise without a size of its own: four octaves, mean 0, about [-0.5, 0.5].
float clouds(vec2 p, float per_meter, int salt) {
  return 0.53 * grain(p, per_meter, salt) + 0.27 * grain(p, 2.0 * per_meter, salt + 1) +
         0.13 * grain(p, 4.0 * per_meter, salt + 2) + 0.07 * grain(p, 8.0 * per_meter, salt + 3) - 0.5;
}

// How far inside a round spot of at most `radius` m a point is, 0 to 1: one spot in a `share` of
// squares, `per_metre` of which fit into a meter.
float spot(vec2 p, float per_meter, float share, float radius, int salt) {
  ivec2 count = ivec2(int(per_meter * kTileM + 0.5));
  vec2 at = p * vec2(count) / kTileM;
  ivec2 cell = ivec2(floor(at));
  float r = radius * (0.5 + 0.5 * pick(cell, count, salt + 3));
  float room = kTileM / float(count.x) - 2.0 * r;
  vec2 middle = r + room * vec2(pick(cell, count, salt), pick(cell, count, salt + 1));
  float away = length(fract(at) * kTileM / vec2(count) - middle);
  return pick(cell, count, salt + 2) < share ? clamp(1.0 - away / r, 0.0, 1.0) : 0.0;
}

// Thin winding lines, where `where` selects them.
float cracks(vec2 p, float per_meter, float where, int salt) {
  float level = grain(p, per_meter, salt) + 0.35 * grain(p, 5.0 * per_meter, salt + 1) - 0.67;
  return smoothstep(0.016, 0.004, abs(level)) * step(where, grain(p, 0.21, salt + 2));
}
