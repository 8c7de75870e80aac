// Cast panels of 3 m with sawn joints.
vec3 ground_albedo(vec2 p, vec2 width) {
  const float kPanel = 3.0;
  vec2 joints = stripes_xy(p / kPanel, 0.015 / kPanel, width / kPanel);
  float tone = hash(ivec2(floor(p / kPanel))) - 0.5;
  float stain = noise(p * 0.45) + 0.5 * noise(p * 2.1 + 11.0) - 0.75;
  vec3 albedo = vec3(0.42, 0.41, 0.385) * (1.0 + 0.1 * tone + 0.14 * stain);
  return albedo * (1.0 - 0.5 * max(joints.x, joints.y));
}
