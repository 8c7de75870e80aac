// Worn asphalt: aggregate and cracks.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 12.0 * max(width.x, width.y), 0.0, 1.0);
  vec3 albedo = vec3(0.168, 0.166, 0.163);
  albedo *= 1.0 + 0.55 * (grain(p, 36.0, 1) - 0.5) * fade + 0.35 * (grain(p, 14.0, 2) - 0.5) * fade;
  albedo *= 1.0 + 0.14 * clouds(p, 0.9, 3) + 0.14 * clouds(p, 2.8, 7);
  albedo *= 1.0 - 0.45 * cracks(p, 0.49, 0.55, 16) * fade;
  return albedo;
}
