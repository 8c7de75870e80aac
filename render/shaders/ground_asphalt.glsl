// Worn asphalt: aggregate, darker repairs and long faint tracks.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 12.0 * max(width.x, width.y), 0.0, 1.0);
  float aggregate = (noise(p * 24.0) - 0.5) * fade;
  float wear = noise(p * vec2(0.09, 0.5)) + 0.5 * noise(p * 0.7 + 31.0) - 0.75;
  float repair = smoothstep(0.66, 0.68, noise(floor(p * vec2(0.5, 0.8)) * 0.37));
  vec3 albedo = vec3(0.165, 0.163, 0.16) * (1.0 + 0.35 * aggregate + 0.3 * wear);
  return albedo * (1.0 - 0.18 * repair);
}
