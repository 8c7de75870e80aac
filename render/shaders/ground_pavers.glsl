// Granite slabs of 0.9 x 0.6 m in running bond, in fields of 7.2 m framed by darker bands.
vec3 ground_albedo(vec2 p, vec2 width) {
  const vec2 kSlab = vec2(0.9, 0.6);
  const float kJoint = 0.014;
  float row = floor(p.y / kSlab.y);
  vec2 slab = vec2(p.x / kSlab.x + 0.5 * mod(row, 2.0), p.y / kSlab.y);
  vec2 slab_width = width / kSlab;
  float joint = max(stripes(slab.x, kJoint / kSlab.x, slab_width.x),
                    stripes(slab.y, kJoint / kSlab.y, slab_width.y));
  float fade = clamp(1.5 - 2.0 * max(slab_width.x, slab_width.y), 0.0, 1.0);
  ivec2 cell = ivec2(floor(slab));
  float tone = (hash(cell) - 0.5) * fade;
  float warmth = (hash(cell + 7919) - 0.5) * fade;
  vec2 field = stripes_xy(p / 7.2, 0.6 / 7.2, width / 7.2);
  float frame = max(field.x, field.y);
  float stain = noise(p * 0.31) + 0.5 * noise(p * 1.13 + 17.0) - 0.75;
  vec3 albedo = vec3(0.40, 0.375, 0.34) * (1.0 + 0.22 * tone);
  albedo *= 1.0 + 0.07 * warmth * vec3(1.0, 0.0, -1.0);
  albedo = mix(albedo, vec3(0.20, 0.195, 0.19) * (1.0 + 0.2 * tone), 0.85 * frame);
  albedo *= 1.0 - 0.55 * joint;
  return albedo * (1.0 + 0.16 * stain);
}
