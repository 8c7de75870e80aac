// Worn asphalt: aggregate, repairs with sealed edges, cracks, oil.
vec3 ground_albedo(vec2 p, vec2 width) {
  float fade = clamp(1.5 - 12.0 * max(width.x, width.y), 0.0, 1.0);
  vec3 albedo = vec3(0.168, 0.166, 0.163);
  albedo *= 1.0 + 0.55 * (grain(p, 36.0, 1) - 0.5) * fade + 0.35 * (grain(p, 14.0, 2) - 0.5) * fade;
  albedo *= 1.0 + 0.42 * clouds(p, 0.28, 3) + 0.22 * clouds(p, 1.8, 7);
  const ivec2 kRepairs = ivec2(3, 4);
  vec2 at = p * vec2(kRepairs) / kTileM;
  ivec2 cell = ivec2(floor(at));
  vec2 room = kTileM / vec2(kRepairs);
  vec2 chosen = vec2(pick(cell, kRepairs, 11), pick(cell, kRepairs, 12));
  vec2 half_size = room * (0.06 + 0.3 * chosen * chosen);
  // Anywhere in their cells, and not quite straight.
  vec2 place = vec2(pick(cell, kRepairs, 17), pick(cell, kRepairs, 18)) - 0.5;
  vec2 middle = 0.5 * room + 1.8 * place * (0.46 * room - half_size);
  vec2 off = fract(at) * room - middle;
  float lean = 0.16 * (pick(cell, kRepairs, 19) - 0.5);
  vec2 from_middle = abs(off + lean * vec2(-off.y, off.x)) + 0.025 * clouds(p, 2.0, 28);
  float inside = min(half_size.x - from_middle.x, half_size.y - from_middle.y);
  float there = step(pick(cell, kRepairs, 13), 0.42);
  float tone = pick(cell, kRepairs, 14) < 0.6 ? -0.20 : 0.14;
  albedo *= 1.0 + there * tone * smoothstep(-0.01, 0.01, inside) * fade;
  albedo *= 1.0 - 0.42 * there * smoothstep(0.035, 0.015, abs(inside)) * fade;
  albedo *= 1.0 - 0.45 * cracks(p, 0.49, 0.55, 16) * fade;
  float oil = smoothstep(0.1, 0.8, spot(p, 0.35, 0.4, 0.7, 20) + 0.8 * clouds(p, 2.0, 24));
  return albedo * (1.0 - 0.35 * oil);
}
