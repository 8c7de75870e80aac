// Maps the bones of a foreign rig to ours by their names: Mixamo, VRM, Blender's Rigify, MakeHuman,
// 3ds Max Biped, Unreal, Daz, motion capture files and what resembles them.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skinning/import/rigged_model.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Node of each of our bones; -1 where the rig has none.
using BoneNodes = std::array<int, kBoneCount>;

/// Bones that a rig must have. The others are placed between these.
bool is_needed(Bone bone);

/// Maps a rig by its names, after the user's names ("left_thigh" to "Leg1.L"). Throws InputError
/// with one problem for each needed bone that no name fits, naming the bones that were not
/// recognized and the most similar of them, and for each of the user's names that there is not.
/// `where` is the file that the user's names stand in.
BoneNodes map_bones(const RiggedModel& model, const std::map<std::string, std::string>& overrides,
                    const std::string& where);

/// The most similar of the names; empty when there are none.
std::string most_similar(const std::string& name, const std::vector<std::string>& names);

}  // namespace throng::skinning
