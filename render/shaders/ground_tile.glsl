// Irregularity for the grounds, repeated with the tile that their textures hold. `salt`
// distinguishes patterns of one material apart.
const float kTileM = 14.4;  // also in render/ground/ground_texture.h

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

// Thin winding lines, where `where` selects them: some of the borders between cells around random
// points (Worley 1996), so that they meet and end, and enclose nothing.
float cracks(vec2 p, float per_meter, float where, int salt) {
  float chosen = step(where, grain(p, 0.21, salt + 2));
  p += 0.5 * (vec2(grain(p, 1.4, salt), grain(p, 1.4, salt + 1)) - 0.5);
  p += 0.12 * (vec2(grain(p, 7.0, salt + 3), grain(p, 7.0, salt + 4)) - 0.5);
  ivec2 count = ivec2(int(per_meter * kTileM + 0.5));
  vec2 at = p * vec2(count) / kTileM;
  ivec2 cell = ivec2(floor(at));
  vec2 nearest = vec2(9.0);  // two distances
  ivec2 owners = ivec2(0);   // the cells' numbers
  for (int i = 0; i < 9; ++i) {
    ivec2 other = cell + ivec2(i % 3 - 1, i / 3 - 1);
    vec2 middle = vec2(other) + vec2(pick(other, count, salt + 5), pick(other, count, salt + 6));
    float away = length(at - middle);
    ivec2 own = wrapped(other, count);
    int number = own.y * count.x + own.x;
    if (away < nearest.x) {
      nearest = vec2(away, nearest.x);
      owners = ivec2(number, owners.x);
    } else if (away < nearest.y) {
      nearest.y = away;
      owners.y = number;
    }
  }
  ivec2 pair = ivec2(min(owners.x, owners.y), max(owners.x, owners.y));
  float is_there = step(hash(pair + ivec2(salt * 17, salt * 29)), 0.4);
  float off_m = 0.5 * (nearest.y - nearest.x) * kTileM / float(count.x);
  return smoothstep(0.016, 0.005, off_m) * is_there * chosen;
}
