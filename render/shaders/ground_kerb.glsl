// Kerb stones of 1 m along a strip, with a dark joint on either side of it.
vec3 ground_albedo(vec2 p, vec2 width) {
  float joint = stripes(p.x, 0.02, width.x);
  float tone = (hash(ivec2(floor(p.x), 5)) - 0.5) * clamp(1.5 - width.x, 0.0, 1.0);
  float sides = 1.0 - band(p.y, 0.012, 0.135, width.y);
  vec3 albedo = vec3(0.46, 0.455, 0.44) * (1.0 + 0.2 * tone + 0.2 * (noise(p * 9.0) - 0.5));
  return albedo * (1.0 - 0.5 * joint) * (1.0 - 0.55 * sides);
}
