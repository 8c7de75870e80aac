// Characters and libraries of them as values: rig, meshes, textures, clips. Nothing here touches
// GL.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace throng::skinning {

inline constexpr int kBoneCount = 21;

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

/// Model space: meters, Z up, facing +X, origin on the ground below the pelvis.
struct Vertex {
  std::array<float, 3> position;
  std::array<float, 3> normal;
  std::array<float, 2> uv;
  std::array<std::uint8_t, 4> bones;
  std::array<std::uint8_t, 4> weights;  ///< sum is exactly 255
};
static_assert(sizeof(Vertex) == 40);

/// Per-instance color of a part of a character. The albedo of a tinted part is its texture times
/// the instance's tint, both in linear light; such textures hold light and shade only. Tint::none
/// is not tinted. Hats are colored like shoes. A portrait has all colors but the item's at once:
/// its texture holds what is not tinted, black elsewhere, and its shades hold how bright the rest
/// is: top, bottom, hair and shoes in red, green, blue (as sRGB) and alpha (linear). Its albedo is
/// the first plus the sum of the latter times the instance's tints.
enum class Tint : std::uint8_t { none, top, bottom, hair, shoes, item, portrait };
inline constexpr std::size_t kTintCount =
    6;  ///< colors of an instance; a portrait has none of its own

/// Names of the tints in files, by Tint.
inline constexpr std::array<std::string_view, kTintCount + 1> kTintNames = {
    "none", "top", "bottom", "hair", "shoes", "item", "portrait"};

using Rgb = std::array<std::uint8_t, 3>;  ///< sRGB

/// A run of triangles with one texture.
struct Part {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::int32_t texture = -1;  ///< layer of Population::textures
  Tint tint = Tint::none;
  bool alpha_tested =
      false;  ///< discard where texture alpha < 0.5; rendered without back-face culling
  std::int32_t shades = -1;  ///< a portrait's second layer
};

/// One level of detail: an indexed triangle mesh (counter-clockwise seen from outside).
struct Mesh {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Part> parts;
};

/// Carried item; see items.h for its attachment. Umbrellas are open; characters with one take part
/// when it rains (Styling::umbrellas).
enum class Carry : std::uint8_t { nothing, backpack, shoulder_bag, handbag, umbrella };
inline constexpr std::size_t kCarryCount = 5;

struct Character {
  std::string name;
  float stature_m = 0;  ///< sole of the shoes to crown, standing
  float age_years = 35;
  bool male = true;
  Carry carries = Carry::nothing;
  std::string wears;         ///< in words, e.g. "t-shirt, jeans, trainers"
  std::vector<Mesh> levels;  ///< from most to least detailed; at least one
  /// Joint position of each bone in the rest pose, in model space.
  std::array<Eigen::Vector3f, kBoneCount> joints{};
  /// Colors that suit this character, by Tint: what sample_appearance picks from.
  std::array<std::vector<Rgb>, kTintCount> tints;
};

/// Whether a part is a separate object rather than the person's: an open umbrella, which hides its
/// owner as a stranger's would.
bool is_apart(const Character& character, const Part& part);

/// All textures have one square size, so that they fit one texture array.
struct Texture {
  std::vector<std::uint8_t> rgba;  ///< size * size * 4, sRGB, top row first
};

/// A bone's motion: rest-pose model space to posed model space, 3x4 row-major affine.
using BoneMatrix = Eigen::Matrix<float, 3, 4, Eigen::RowMajor>;
using Palette = std::array<BoneMatrix, kBoneCount>;

/// Frames of one clip inside every character's palettes.
struct Clip {
  std::string name;          ///< what it shows, e.g. "walk"; the list is in clips.h
  float speed_mps = 0;       ///< natural ground speed of a person of 1.7 m; 0 on the spot
  std::uint32_t first = 0;   ///< index of its first palette
  std::uint32_t frames = 0;  ///< evenly spaced
  float stride = 0;          ///< length of a stride (two steps), in statures; 0 on the spot
  float middle = 0;          ///< phase at which the left foot is below the body as in standing
  bool cyclic = true;        ///< the first frame follows the last
};

struct Population {
  std::string content_hash;  ///< SHA-256 of everything that the people were made from
  std::vector<Character> characters;
  int texture_size = 0;
  std::vector<Texture> textures;
  std::vector<Clip> clips;
  std::uint32_t palettes_per_character = 0;
  std::vector<Palette> palettes;  ///< [character][palette]

  const Palette& palette(std::size_t character, std::size_t index) const {
    return palettes[character * palettes_per_character + index];
  }
};

}  // namespace throng::skinning
