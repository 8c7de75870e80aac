// Granite cubes of 0.1 m in rows along a strip, in staggered joints.
vec3 ground_albedo(vec2 p, vec2 width) {
  const float kSett = 0.1;
  float fade = clamp(1.5 - 8.0 * max(width.x, width.y), 0.0, 1.0);
  vec2 at = p / kSett;
  at.x += 0.5 * mod(floor(at.y), 2.0);
  vec2 joints = stripes_xy(at, 0.15, width / kSett);
  float tone = (hash(ivec2(floor(at))) - 0.5) * fade + 0.35 * (noise(p * vec2(0.5, 1.5)) - 0.5);
  return vec3(0.205, 0.198, 0.190) * (1.0 + 0.5 * tone) * (1.0 - 0.45 * max(joints.x, joints.y));
}
