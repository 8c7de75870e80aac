// A person: blends two palettes, skins, turns and places the body. With SHADOW it is flattened into
// the shadow map instead of being seen by the camera.
layout(location = 0) in vec3 position_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec2 uv_in;
layout(location = 3) in uvec4 bones;
layout(location = 4) in vec4 weights;
layout(location = 5) in uint part;             // texture layer, tint << 16
layout(location = 6) in vec4 position_yaw;     // per instance from here
layout(location = 7) in uvec4 pose;            // palettes a and b, blend (a float's bits), id
layout(location = 8) in uvec4 tints;           // top, bottom, hair, shoes: sRGB, red lowest
layout(location = 9) in ivec2 shift;           // pixels

layout(std430, binding = 0) readonly buffer Palettes {
  vec4 bone_rows[];  // [character][palette][bone][3]
};

const int kRowsPerPalette = 63;
const float kAboveGround = 0.002;  // m; also in render/person_geometry.cpp

mat3x4 blended_rows() {
  mat3x4 rows = mat3x4(0.0);
  float b = uintBitsToFloat(pose.z);
  for (int k = 0; k < 4; ++k) {
    int row_a = int(pose.x) * kRowsPerPalette + 3 * int(bones[k]);
    int row_b = int(pose.y) * kRowsPerPalette + 3 * int(bones[k]);
    for (int i = 0; i < 3; ++i) {
      rows[i] += weights[k] * mix(bone_rows[row_a + i], bone_rows[row_b + i], b);
    }
  }
  return rows;
}

vec3 placed(vec3 model) {
  float c = cos(position_yaw.w);
  float s = sin(position_yaw.w);
  vec3 world = position_yaw.xyz + vec3(c * model.x - s * model.y, s * model.x + c * model.y, model.z);
  // Nobody sinks into the ground, so the ground never hides a part of a person.
  world.z = max(world.z, position_yaw.z + kAboveGround);
  return world;
}

#ifdef SHADOW
void main() {
  vec3 world = placed(vec4(position_in, 1.0) * blended_rows());
  gl_Position = vec4(shadow_uv(world) * 2.0 - 1.0, world.z * light.shadow_slope.z, 1.0);
}
#else
out vec3 world;
out vec2 uv;
out vec2 received;  // from the sun, from the sky; before shadows
flat out vec3 tint;
flat out uint layer;
flat out uint id;

vec3 linear_from_srgb(vec3 c) {
  return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

void main() {
  mat3x4 rows = blended_rows();
  world = placed(vec4(position_in, 1.0) * rows);
  vec3 n = normalize(vec4(normal_in, 0.0) * rows);
  float c = cos(position_yaw.w);
  float s = sin(position_yaw.w);
  n = vec3(c * n.x - s * n.y, s * n.x + c * n.y, n.z);
  received = vec2(max(dot(n, light.sun_direction.xyz), 0.0), 0.5 + 0.5 * n.z);
  uv = uv_in;
  layer = part & 0xFFFFu;
  uint slot = part >> 16;
  tint = slot == 0u ? vec3(1.0) : linear_from_srgb(unpackUnorm4x8(tints[slot - 1u]).rgb);
  id = pose.w;
  gl_Position = project_movable(world, shift);
}
#endif
