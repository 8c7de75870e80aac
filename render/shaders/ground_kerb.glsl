// Kerb stones of 1 m.
vec3 ground_albedo(vec2 p, vec2 width) {
  float along = p.x + p.y;
  float joint = stripes(along, 0.02, width.x + width.y);
  float tone = (hash(ivec2(floor(p))) - 0.5) * clamp(1.5 - max(width.x, width.y), 0.0, 1.0);
  return vec3(0.46, 0.455, 0.44) * (1.0 + 0.14 * tone) * (1.0 - 0.6 * joint);
}
