// Granite slabs of 0.9 x 0.6 m in running bond. Larger features, which would show how the tile
// repeats, are geometry (render/ground/ground_edges.h) and decals.
vec3 ground_albedo(vec2 p, vec2 width) {
  const vec2 kSlab = vec2(0.9, 0.6);
  const ivec2 kSlabs = ivec2(16, 24);
  const float kJoint = 0.014;
  float row = floor(p.y / kSlab.y);
  vec2 slab = vec2(p.x / kSlab.x + 0.5 * mod(row, 2.0), p.y / kSlab.y);
  vec2 slab_width = width / kSlab;
  float joint = max(stripes(slab.x, kJoint / kSlab.x, slab_width.x),
                    stripes(slab.y, kJoint / kSlab.y, slab_width.y));
  float fade = clamp(1.5 - 2.0 * max(slab_width.x, slab_width.y), 0.0, 1.0);
  ivec2 cell = ivec2(floor(slab));
  float tone = (pick(cell, kSlabs, 1) - 0.5) * fade;
  float warmth = (pick(cell, kSlabs, 2) - 0.5) * fade;
  // A few slabs were laid later, from another quarry.
  float newer = step(0.955, pick(cell, kSlabs, 3)) * fade;
  vec3 albedo = vec3(0.308, 0.289, 0.263) * (1.0 + 0.24 * tone - 0.16 * newer);
  albedo *= 1.0 + 0.08 * warmth * vec3(1.0, 0.0, -1.0);
  albedo *= 1.0 + 0.30 * (grain(p, 34.0, 4) - 0.5) * fade;
  // Dirt gathers along the joints, more of it in some places.
  vec2 edge = min(fract(slab), 1.0 - fract(slab)) * kSlab;
  float dirty = grain(p, 0.35, 6);
  float rim = smoothstep(0.09, 0.0, min(edge.x, edge.y)) * fade;
  albedo *= 1.0 - 0.30 * rim * smoothstep(0.25, 0.85, dirty + 0.4 * clouds(p, 2.2, 8));
  albedo *= 1.0 - (0.35 + 0.4 * dirty) * joint;
  albedo *= 1.0 + 0.16 * clouds(p, 0.9, 12) + 0.12 * clouds(p, 2.4, 16);
  return albedo;
}
