// A lawn: clumps of two hues over bare patches.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 6.0 * max(width.x, width.y), 0.0, 1.0);
  float blades = (noise(p * 9.0) - 0.5) * fade;
  float clumps = noise(p * 0.8);
  float field = noise(p * 0.11 + 5.0);
  vec3 albedo = mix(vec3(0.075, 0.125, 0.035), vec3(0.15, 0.17, 0.06), clumps);
  albedo = mix(albedo, vec3(0.19, 0.16, 0.09), 0.6 * smoothstep(0.62, 0.9, field));
  return albedo * (1.0 + 0.5 * blades);
}
