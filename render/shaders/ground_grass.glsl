// A lawn: clumps of several hues, worn patches, fallen leaves.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 6.0 * max(width.x, width.y), 0.0, 1.0);
  float blades = (grain(p, 34.0, 1) - 0.5 + 0.6 * (grain(p, 12.0, 2) - 0.5)) * fade;
  float clumps = clamp(0.5 + 1.1 * clouds(p, 0.9, 3), 0.0, 1.0);
  vec3 albedo = mix(vec3(0.065, 0.115, 0.03), vec3(0.15, 0.175, 0.06), clumps);
  float worn = smoothstep(0.10, 0.34, clouds(p, 0.21, 7) + 0.3 * clouds(p, 3.0, 11));
  albedo = mix(albedo, vec3(0.22, 0.18, 0.11), 0.75 * worn);
  float clover = smoothstep(0.15, 0.3, clouds(p, 0.6, 15));
  albedo = mix(albedo, vec3(0.06, 0.125, 0.045), 0.6 * clover * (1.0 - worn));
  albedo *= 1.0 + 0.75 * blades;
  float leaf = step(0.15, spot(p, 3.0, 0.10, 0.05, 19)) * fade;
  return mix(albedo, vec3(0.24, 0.16, 0.06), 0.7 * leaf);
}
