// Trodden earth with stones.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 10.0 * max(width.x, width.y), 0.0, 1.0);
  float stones = smoothstep(0.72, 0.8, noise(p * 14.0)) * fade;
  float grain = (noise(p * 31.0) - 0.5) * fade;
  float tread = noise(p * 0.6) + 0.5 * noise(p * 1.9 + 5.0) - 0.75;
  vec3 albedo = vec3(0.27, 0.205, 0.14) * (1.0 + 0.3 * tread + 0.25 * grain);
  return mix(albedo, vec3(0.36, 0.34, 0.31), 0.6 * stones);
}
