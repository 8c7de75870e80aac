// Trodden earth with stones.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 10.0 * max(width.x, width.y), 0.0, 1.0);
  vec3 albedo = vec3(0.27, 0.205, 0.14);
  albedo *= 1.0 + 0.5 * clouds(p, 0.35, 1) + 0.3 * clouds(p, 2.0, 5);
  albedo *= 1.0 + 0.4 * (grain(p, 32.0, 9) - 0.5) * fade;
  float stones = step(0.2, spot(p, 5.0, 0.3, 0.024, 10)) * fade;
  albedo = mix(albedo, vec3(0.30, 0.28, 0.25) * (0.7 + 0.6 * grain(p, 9.0, 14)), 0.7 * stones);
  float weeds = smoothstep(0.62, 0.8, grain(p, 0.8, 15) + 0.3 * clouds(p, 5.0, 16));
  return mix(albedo, vec3(0.11, 0.14, 0.05), 0.5 * weeds);
}
