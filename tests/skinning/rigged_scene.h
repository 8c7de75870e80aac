// Rigged models made up for the tests, written by assimp as others' programs would.
#pragma once

#include <assimp/scene.h>

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "tests/skinning/made_up.h"

namespace throng::skinning {

struct RiggedOptions {
  /// Name of each bone; empty leaves it out, and its vertices go to what carries it.
  std::function<std::string(Bone)> name;
  float unit = 100;      ///< of the file in a meter
  bool z_up = false;     ///< facing -Y, as in Blender; else Y up and facing +Z
  bool t_pose = false;   ///< arms straight out to the sides
  bool swapped = false;  ///< left and right exchanged in the names
  bool bones = true;     ///< else the mesh hangs on nothing
  bool fingers = false;  ///< the far halves of hands hang on a bone of their own
  bool walks = false;    ///< with a clip "Stroll": one stride of 1.2 m in 1 s, left arm up
  float mesh_scale = 1;  ///< of the mesh against its skeleton
  int cuts = 2;          ///< along each side of the boxes that limbs are made of
  std::string image;     ///< file of the color; empty for a plain one
};

inline constexpr double kStrollSpeedMps = 1.2;

/// Names as Mixamo gives them.
std::string mixamo_name(Bone bone);

/// Somebody of 1.8 m with the joints of made_up_joints().
std::unique_ptr<aiScene> rigged_scene(const RiggedOptions& options);

/// Writes it; `format` is one of assimp's ids: "glb2", "gltf2", "fbx", "collada".
void write_scene(const aiScene& scene, const std::string& format,
                 const std::filesystem::path& file);

}  // namespace throng::skinning
