// Cast panels of 2.4 m with sawn joints.
vec3 ground_albedo(vec2 p, vec2 width) {
  const float kPanel = 2.4;
  const ivec2 kPanels = ivec2(6);
  float fade = clamp(1.5 - 12.0 * max(width.x, width.y), 0.0, 1.0);
  vec2 joints = stripes_xy(p / kPanel, 0.015 / kPanel, width / kPanel);
  float tone = pick(ivec2(floor(p / kPanel)), kPanels, 1) - 0.5;
  vec3 albedo = vec3(0.36, 0.351, 0.330) * (1.0 + 0.12 * tone);
  albedo *= 1.0 + 0.14 * clouds(p, 0.8, 2) + 0.12 * clouds(p, 2.2, 6);
  albedo *= 1.0 + 0.14 * (grain(p, 34.0, 10) - 0.5) * fade;
  albedo *= 1.0 - 0.3 * cracks(p, 0.42, 0.68, 12) * fade;
  return albedo * (1.0 - 0.5 * max(joints.x, joints.y));
}
