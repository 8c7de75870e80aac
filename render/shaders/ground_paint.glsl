// White road paint, worn through to the asphalt in places.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 8.0 * max(width.x, width.y), 0.0, 1.0);
  float wear = noise(p * 1.3 + 8.0) * 0.6 + noise(p * 19.0) * 0.4 * fade;
  return mix(vec3(0.60, 0.60, 0.57), vec3(0.20, 0.197, 0.19), smoothstep(0.52, 0.72, wear));
}
