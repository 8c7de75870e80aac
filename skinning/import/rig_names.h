// Maps the bones of a foreign rig by their names: Mixamo, VRM, Blender's Rigify, MakeHuman, 3ds Max
// Biped, Unreal, Daz, motion capture files and similar conventions.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "skinning/import/rigged_model.h"
#include "skinning/skeleton.h"

namespace throng::skinning {

/// Index of the node for each Bone; -1 if the rig has none.
using BoneNodes = std::array<int, kBoneCount>;

/// Whether a rig must have this bone. Others are interpolated.
bool is_needed(Bone bone);

/// Maps a rig by the user's `overrides` ("left_thigh" to "Leg1.L"), then by its names. Throws
/// InputError with one problem for each needed bone without a matching name (with the unrecognized
/// bones and the most similar name) and for each override that does not exist. `where` is the file
/// that contains the overrides.
BoneNodes map_bones(const RiggedModel& model, const std::map<std::string, std::string>& overrides,
                    const std::string& where);

/// The most similar of `names`, or "" if there are none.
std::string most_similar(const std::string& name, const std::vector<std::string>& names);

}  // namespace throng::skinning
