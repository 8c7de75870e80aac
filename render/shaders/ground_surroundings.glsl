// The plain around the scenario, seen past its edge: dry grass and bare earth, no detail.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 0.5 * max(width.x, width.y), 0.0, 1.0);
  float patches = (noise(p * 0.05) + 0.5 * noise(p * 0.31 + 3.0) - 0.75) * fade;
  return mix(vec3(0.20, 0.21, 0.13), vec3(0.30, 0.27, 0.20), clamp(0.5 + patches, 0.0, 1.0));
}
