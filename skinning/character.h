// Characters and character libraries as values: rig, meshes, textures, clips. Independent of GL.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace throng::skinning {

inline constexpr int kBoneCount = 21;
/// The bone of vertices that stay where they are in model space, such as those of a pram: they are
/// turned and moved with the person, but with none of the body's motion. No palette has it.
inline constexpr std::uint8_t kStillBone = kBoneCount;

/// The rig, in palette order.
enum class Bone : std::uint8_t {
  hips,
  spine,
  chest,
  neck,
  head,
  left_clavicle,
  left_upper_arm,
  left_forearm,
  left_hand,
  right_clavicle,
  right_upper_arm,
  right_forearm,
  right_hand,
  left_thigh,
  left_shin,
  left_foot,
  left_toe,
  right_thigh,
  right_shin,
  right_foot,
  right_toe,
};

/// A vertex in model space: meters, Z up, facing +X, origin on the ground below the pelvis.
struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::array<float, 2> uv;
  std::array<std::uint8_t, 4> bones;
  std::array<std::uint8_t, 4> weights;  ///< sum is exactly 255
};
static_assert(sizeof(Vertex) == 40);

/// Per-instance color of a part of a character. The albedo of a tinted part is its texture, which
/// has only light and shade, times the instance's tint, both in linear light. Tint::none is not
/// tinted; hats have the tint of shoes. A portrait combines all tints except the item's: its
/// texture contains the parts that are not tinted (black elsewhere); its shades contain the
/// brightness of top, bottom, hair and shoes in red, green, blue (sRGB) and alpha (linear). Its
/// albedo is the texture plus the sum of the shades times the instance's tints.
enum class Tint : std::uint8_t { none, top, bottom, hair, shoes, item, portrait };
inline constexpr std::size_t kTintCount =
    6;  ///< colors of an instance; a portrait has none of its own

/// Names of the tints in files, by Tint.
inline constexpr std::array<std::string_view, kTintCount + 1> kTintNames = {
    "none", "top", "bottom", "hair", "shoes", "item", "portrait"};

using Rgb = std::array<std::uint8_t, 3>;  ///< sRGB

/// A range of triangles with one texture.
struct Part {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::int32_t texture = -1;  ///< layer of Population::textures
  Tint tint = Tint::none;
  bool alpha_tested =
      false;  ///< discard where texture alpha < 0.5; rendered without back-face culling
  std::int32_t shades = -1;  ///< layer of a portrait's shades
};

/// One level of detail: an indexed triangle mesh, counter-clockwise from outside.
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
};

/// A carried or led item; see items.h for its attachment. Umbrellas are open; characters with
/// umbrellas take part only in rain (Styling::umbrellas), those who lead something on wheels only
/// where the crowd has room for it (Styling::leading).
enum class Carry : std::uint8_t {
  nothing,
  backpack,
  shoulder_bag,
  handbag,
  umbrella,
  walking_stick,
  suitcase,  ///< pulled
  pram,      ///< pushed
  bicycle    ///< pushed
};
inline constexpr std::size_t kCarryCount = 9;

/// Whether an item is on wheels and led over the ground.
inline constexpr bool is_led(Carry carry) { return carry >= Carry::suitcase; }

/// A person of the library: body, clothes and levels of detail.
struct Character {
  std::string name;
  float stature_m = 0;  ///< sole of the shoes to crown, standing
  /// Stature of people of usual proportions with legs of this character's length, whose strides are
  /// its own; 0: its stature.
  float legs_stature_m = 0;
  float age_years = 35;
  bool male = true;
  Carry carries = Carry::nothing;
  std::string wears;         ///< description, such as "t-shirt, jeans, trainers"
  std::vector<Mesh> levels;  ///< from most to least detailed; at least one
  /// Joint position of each bone in the rest pose, in model space.
  std::array<Eigen::Vector3f, kBoneCount> joints{};
  /// Colors that suit this character, by Tint, from which sample_appearance() chooses.
  std::array<std::vector<Rgb>, kTintCount> tints;

  /// The stature by which strides and speeds of running are chosen.
  float gait_stature_m() const { return legs_stature_m > 0 ? legs_stature_m : stature_m; }
};

/// Whether a part is a separate object instead of a part of the person: an open umbrella, which
/// occludes its owner, or what the person leads.
bool is_apart(const Character& character, const Part& part);

/// A texture. All textures of a library are squares of the same size, for one texture array.
struct Texture {
  std::vector<std::uint8_t> rgba;  ///< size * size * 4, sRGB, top row first
};

/// A bone's motion from the rest pose to the pose, in model space: 3x4 row-major affine.
using BoneMatrix = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;
using Palette = std::array<BoneMatrix, kBoneCount>;

/// The matrix of a vertex's bone: that of the palette, or none of its motion (kStillBone).
inline BoneMatrix bone_matrix(const Palette& palette, std::size_t bone) {
  return bone == kStillBone ? BoneMatrix(BoneMatrix::Identity()) : palette[bone];
}

/// The frames of a clip within every character's palettes.
struct Clip {
  std::string name;          ///< name of the motion, such as "walk"; clips.h has the list
  float speed_mps = 0;       ///< natural speed of a person of 1.7 m; 0: on the spot
  std::uint32_t first = 0;   ///< index of its first palette
  std::uint32_t frames = 0;  ///< number of evenly spaced frames
  float stride = 0;          ///< length of a stride (two steps), in statures; 0: on the spot
  float middle = 0;          ///< phase at which the left foot is below the body as in standing
  bool cyclic = true;        ///< the first frame follows the last
};

}  // namespace throng::skinning
