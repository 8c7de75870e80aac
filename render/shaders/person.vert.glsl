// A person: blends two palettes, skins, turns and places the body. With SHADOW it is flattened into
// the shadow map instead of being seen by the camera; with CORNERS it is lit and colored corner by
// corner, with LIT_CORNERS only lit so; with SURFACE it carries what person_surface.frag.glsl writes.
layout(location = 0) in vec3 position_in;
layout(location = 1) in uvec4 skin;     // bones, weights, part, normal: see render/people/people_meshes.h
layout(location = 2) in vec2 uv_in;
layout(location = 3) in uvec2 colors;  // the texture around this corner, sRGB; of a portrait, linear
layout(location = 4) in vec3 foot;      // per instance from here: position, m
layout(location = 5) in uvec4 pose;     // palettes a and b, blend (a float's bits), id
layout(location = 6) in uvec4 tints;    // top, bottom, hair, shoes: sRGB, red lowest; item: high bytes
layout(location = 7) in uvec4 placing;  // shift in pixels; cosine and sine of the heading (bits)
layout(location = 11) in uvec4 field;   // light around the person, half floats: that from everywhere,
layout(location = 12) in uvec2 field_blue;  // then a vector for each color

layout(binding = 3) uniform usamplerBuffer posed_bones;  // [character][palette][bone]; device_palettes.h

const int kBones = 21;
const float kMaxShift = 8.0;  // m; also in render/people/device_palettes.h
const float kAboveGround = 0.002;  // m; also in render/people/person_geometry.cpp

uint first_byte(uint word) { return word & 0xFFu; }

// The rows of a bone's matrix.
mat3x4 read_rows(uvec4 bone) {
  vec4 q = vec4(unpackSnorm2x16(bone.x), unpackSnorm2x16(bone.y));
  vec3 shift = kMaxShift * vec3(unpackSnorm2x16(bone.z), unpackSnorm2x16(bone.w).x);
  vec3 d = q.xyz * (2.0 / dot(q, q));
  vec3 squares = d * q.xyz;
  vec3 products = d.xxy * q.yzz;  // xy, xz, yz
  vec3 turns = d * q.w;
  return mat3x4(vec4(1.0 - squares.y - squares.z, products.x - turns.z, products.y + turns.y, shift.x),
                vec4(products.x + turns.z, 1.0 - squares.x - squares.z, products.z - turns.x, shift.y),
                vec4(products.y - turns.y, products.z + turns.x, 1.0 - squares.x - squares.y, shift.z));
}

// The rows of a palette's bone; kStillBone (skinning/character.h) has none of the body's motion.
mat3x4 bone_rows(uint palette, uint bone) {
  if (bone == uint(kBones)) {
    return mat3x4(vec4(1.0, 0.0, 0.0, 0.0), vec4(0.0, 1.0, 0.0, 0.0), vec4(0.0, 0.0, 1.0, 0.0));
  }
  return read_rows(texelFetch(posed_bones, int(palette) * kBones + int(bone)));
}

// The rows of palettes a and b, blended (the blend is a float's bits).
mat3x4 blend_rows(uvec3 pose) {
  mat3x4 rows = mat3x4(0.0);
  float b = uintBitsToFloat(pose.z);
  // Most vertices follow one or two bones, and weights come largest first.
  uint bones = skin.x;
  vec4 weight = unpackUnorm4x8(skin.y);
  int count = int(dot(vec4(greaterThan(weight, vec4(0.0))), vec4(1.0)));
  // In the distance people have one palette: a loop ends where it has ended for all vertices.
  int single = b > 0.0 ? 0 : count;
  for (int k = 0; k < single; ++k) {
    rows += weight.x * bone_rows(pose.x, first_byte(bones));
    bones >>= 8;
    weight = weight.yzwx;
  }
  for (int k = single; k < count; ++k) {
    mat3x4 rows_a = bone_rows(pose.x, first_byte(bones));
    mat3x4 rows_b = bone_rows(pose.y, first_byte(bones));
    rows += (weight.x * (1.0 - b)) * rows_a + (weight.x * b) * rows_b;
    bones >>= 8;
    weight = weight.yzwx;
  }
  return rows;
}

mat3x4 blended_rows() { return blend_rows(pose.xyz); }

// The vertex's normal, from two 16-bit numbers on an octahedron.
vec3 normal_in() {
  vec2 p = unpackSnorm2x16(skin.w);
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  float fold = max(-n.z, 0.0);
  n.xy -= mix(-vec2(fold), vec2(fold), greaterThanEqual(n.xy, vec2(0.0)));
  return n;
}

ivec2 shift() { return ivec2(placing.xy); }

vec2 facing() { return uintBitsToFloat(placing.zw); }

vec3 turned_by(vec2 facing, vec3 v) {
  return vec3(facing.x * v.x - facing.y * v.y, facing.y * v.x + facing.x * v.y, v.z);
}

vec3 turned(vec3 v) { return turned_by(facing(), v); }

vec3 placed_at(vec3 foot, vec2 facing, vec3 model) {
  vec3 world = foot + turned_by(facing, model);
  // Nobody sinks into the ground, so the ground never hides a part of a person.
  world.z = max(world.z, foot.z + kAboveGround);
  return world;
}

vec3 placed(vec3 model) { return placed_at(foot, facing(), model); }

uint part() { return skin.z; }

uint tint_slot() { return part() >> 24 & 0x7Fu; }

// Whether it is a separate object: an umbrella, or what is led.
bool is_apart() { return part() >> 31 != 0u; }

uint instance_id() { return is_apart() ? pose.w | 0x40000000u : pose.w; }  // kIdUmbrella

// A tint's sRGB word: white where the part has none of its own.
uint choose_tint(uint slot) {
  if (slot == 5u) return tints.x >> 24 | tints.y >> 24 << 8 | tints.z >> 24 << 16;
  return slot > 0u && slot < 5u ? tints[slot - 1u] : 0xFFFFFFu;
}

#ifdef SILHOUETTES
flat out ivec2 to_tile;  // from the image, pixels

// Separate parts have no silhouette: they map outside every atlas.
ivec2 way_to_tile() { return is_apart() ? ivec2(1 << 24) : shift(); }
#endif

#if !defined(SHADOW) && !defined(SURFACE) && !defined(COVERAGE)
// Light of sky, lamps, fires and bounces on a surface with this normal.
vec3 ambient_at(vec3 world, vec3 n) {
  vec2 a = unpackHalf2x16(field.x), b = unpackHalf2x16(field.y), c = unpackHalf2x16(field.z);
  vec2 d = unpackHalf2x16(field.w), e = unpackHalf2x16(field_blue.x), f = unpackHalf2x16(field_blue.y);
  vec3 sum = vec3(a, b.x) + vec3(dot(vec3(b.y, c), n), dot(vec3(d, e.x), n), dot(vec3(e.y, f), n));
  sum = max(sum, 0.0);
#ifdef FIRES
  sum += fire_light(world, n);
#endif
  return sum;
}

// The same with the sun.
vec3 light_at(vec3 world, vec3 n) {
  vec3 direct = light.sun.rgb * max(dot(n, light.sun_direction.xyz), 0.0);
#ifdef SHADOWED
  direct *= sunlit_small(world, 0.06);
#endif
  return direct + ambient_at(world, n);
}
#endif

#ifdef SHADOW
void main() {
  vec3 world = placed(vec4(position_in, 1.0) * blended_rows());
  gl_Position = vec4(shadow_uv(world) * 2.0 - 1.0, world.z * light.shadow_slope.z, 1.0);
}
#elif defined(CORNERS)
out vec3 lit;
flat out uint id;

vec3 linear_from_srgb(vec3 c) {
  return c * (c * (c * 0.305306011 + 0.682171111) + 0.012522878);
}

void main() {
  mat3x4 rows = blended_rows();
  vec3 world = placed(vec4(position_in, 1.0) * rows);
  vec3 n = turned(normalize(vec4(normal_in(), 0.0) * rows));
  vec3 base = unpackUnorm4x8(colors.x).rgb;
  vec4 shades = unpackUnorm4x8(colors.y);
  vec3 albedo = linear_from_srgb(base) * linear_from_srgb(unpackUnorm4x8(choose_tint(tint_slot())).rgb);
  for (int i = 0; i < 4; ++i) {
    albedo += shades[i] * linear_from_srgb(unpackUnorm4x8(tints[i]).rgb);
  }
  vec3 received = light_at(world, n);
  gl_Position = project_movable(world, ivec2(0));
#ifdef SILHOUETTES
  to_tile = way_to_tile();
#endif
  lit = film(through_air(albedo * received, world));
  id = instance_id();
}
#elif defined(SURFACE)
layout(location = 8) in vec3 next_foot;  // per instance: the same person in the next frame
layout(location = 9) in uvec4 next_pose;  // palettes a and b, blend, 1 if they are there
layout(location = 10) in vec2 next_facing;

out vec3 normal;
out vec3 next;  // window position times depth, then depth, in the next frame
out vec2 uv;
flat out uvec2 surface;  // texture layer, body part
flat out uint is_next;

// Body parts (render/frame.h) by bone.
const uint kParts[kBones] = uint[](2u, 2u, 2u, 1u, 1u, 2u, 3u, 3u, 3u, 2u, 4u, 4u, 4u,
                                   5u, 5u, 7u, 7u, 6u, 6u, 8u, 8u);
const uint kItem = 9u;

void main() {
  mat3x4 rows = blended_rows();
  vec3 world = placed(vec4(position_in, 1.0) * rows);
  normal = turned(normalize(vec4(normal_in(), 0.0) * rows));
  uv = uv_in;
  surface = uvec2(part() & 0xFFFu,
                  is_apart()         ? 0u
                  : tint_slot() == 5u ? kItem
                                      : kParts[min(first_byte(skin.x), uint(kBones - 1))]);
  is_next = next_pose.w;
  next = vec3(0.0);
  if (is_next != 0u) {
    vec3 model = vec4(position_in, 1.0) * blend_rows(next_pose.xyz);
    vec3 p = next_seen(placed_at(next_foot, next_facing, model));
    next = vec3(p.xy + next_view.focal.zw * p.z, p.z);
  }
  gl_Position = project_movable(world, ivec2(0));
}
#elif defined(COVERAGE)
out vec2 uv;
flat out uint layer;

void main() {
  uv = uv_in;
  layer = part() & 0xFFFu;
  gl_Position = is_apart()
      ? vec4(0.0, 0.0, -1.0, 1.0)  // outside of the clip volume
      : project_movable(placed(vec4(position_in, 1.0) * blended_rows()), shift());
}
#else
#ifdef LIT_CORNERS
out vec3 received;
out vec3 air;  // the light of the air before the camera
out vec2 uv;
#else
out vec4 world_sun;     // position; share of sunlight received before shadows
out vec3 ambient;
out vec2 uv;
#endif
flat out uvec4 surface;  // texture layer, tint as sRGB, id, a portrait's second layer or 0
flat out uvec4 shaded;   // a portrait's tints

void main() {
  mat3x4 rows = blended_rows();
  vec3 world = placed(vec4(position_in, 1.0) * rows);
  vec3 n = turned(normalize(vec4(normal_in(), 0.0) * rows));
#ifdef LIT_CORNERS
  vec4 before = air_before(world);
  received = light_at(world, n) * before.a;
  air = before.rgb;
  uv = uv_in;
#else
  world_sun = vec4(world, max(dot(n, light.sun_direction.xyz), 0.0));
  ambient = ambient_at(world, n);
  uv = uv_in;
#endif
  surface = uvec4(part() & 0xFFFu, choose_tint(tint_slot()), instance_id(), part() >> 12 & 0xFFFu);
  shaded = tints;
  gl_Position = project_movable(world, ivec2(0));
#ifdef SILHOUETTES
  to_tile = way_to_tile();
#endif
}
#endif
