// A person: blends two palettes, skins, turns and places the body. With SHADOW it is flattened into
// the shadow map instead of being seen by the camera.
layout(location = 0) in vec3 position_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 uv_in;
layout(location = 3) in uvec4 bones;
layout(location = 4) in vec4 weights;
layout(location = 5) in uint part;             // texture layer, tint << 16
layout(location = 6) in vec3 foot;             // per instance from here: position, m
layout(location = 7) in uvec4 pose;            // palettes a and b, blend (a float's bits), id
layout(location = 8) in uvec4 tints;           // top, bottom, hair, shoes: sRGB, red lowest; item: high bytes
layout(location = 9) in ivec2 shift;           // pixels
layout(location = 10) in vec2 facing;          // cosine and sine of the heading

layout(std430, binding = 0) readonly buffer Palettes {
  vec4 bone_rows[];  // [character][palette][bone][3]
};

const int kRowsPerPalette = 63;
const float kAboveGround = 0.002;  // m; also in render/person_geometry.cpp

mat3x4 blended_rows() {
  mat3x4 rows = mat3x4(0.0);
  float b = uintBitsToFloat(pose.z);
  // Most vertices follow one or two bones, and weights come largest first.
  uvec4 bone = bones;
  vec4 weight = weights;
  int count = int(dot(vec4(greaterThan(weights, vec4(0.0))), vec4(1.0)));
  for (int k = 0; k < count; ++k) {
    int row_a = int(pose.x) * kRowsPerPalette + 3 * int(bone.x);
    int row_b = int(pose.y) * kRowsPerPalette + 3 * int(bone.x);
    for (int i = 0; i < 3; ++i) {
      rows[i] += weight.x * mix(bone_rows[row_a + i], bone_rows[row_b + i], b);
    }
    bone = bone.yzwx;
    weight = weight.yzwx;
  }
  return rows;
}

vec3 turned(vec3 v) {
  return vec3(facing.x * v.x - facing.y * v.y, facing.y * v.x + facing.x * v.y, v.z);
}

vec3 placed(vec3 model) {
  vec3 world = foot + turned(model);
  // Nobody sinks into the ground, so the ground never hides a part of a person.
  world.z = max(world.z, foot.z + kAboveGround);
  return world;
}

#ifdef SHADOW
void main() {
  vec3 world = placed(vec4(position_in, 1.0) * blended_rows());
  gl_Position = vec4(shadow_uv(world) * 2.0 - 1.0, world.z * light.shadow_slope.z, 1.0);
}
#else
out vec4 world_sun;     // position; sunlight received before shadows
out vec3 uv_sky;        // texture coordinates; share of the sky's light
flat out uvec3 surface;  // texture layer, tint as sRGB, id

void main() {
  mat3x4 rows = blended_rows();
  vec3 world = placed(vec4(position_in, 1.0) * rows);
  vec3 n = turned(normalize(vec4(normal_in, 0.0) * rows));
  world_sun = vec4(world, max(dot(n, light.sun_direction.xyz), 0.0));
  uv_sky = vec3(uv_in, 0.5 + 0.5 * n.z);
  uint slot = part >> 16;
  uint tint = 0xFFFFFFu;
  if (slot == 5u) {
    tint = tints.x >> 24 | tints.y >> 24 << 8 | tints.z >> 24 << 16;
  } else if (slot > 0u) {
    tint = tints[slot - 1u];
  }
  surface = uvec3(part & 0xFFFFu, tint, pose.w);
  gl_Position = project_movable(world, shift);
}
#endif
