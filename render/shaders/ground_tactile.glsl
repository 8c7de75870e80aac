// Slabs of 0.3 m with ribs for blind people's canes.
vec3 ground_albedo(vec2 p, vec2 width) {
  vec2 joints = stripes_xy(p / 0.3, 0.03, width / 0.3);
  float groove = stripes(p.x / 0.06, 0.35, width.x / 0.06);
  float tone = (hash(ivec2(floor(p / 0.3))) - 0.5) * clamp(1.5 - 3.0 * max(width.x, width.y), 0.0, 1.0);
  vec3 albedo = vec3(0.52, 0.50, 0.42) * (1.0 + 0.14 * tone);
  return albedo * (1.0 - 0.28 * groove) * (1.0 - 0.4 * max(joints.x, joints.y));
}
