// Palettes as they are kept in files: how each bone is turned and where the hips are. Everything
// else follows from the joints.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/skeleton.h"

namespace throng::skinning {

/// Size of one palette: a unit quaternion (x, y, z, w; 16-bit, 32767 is 1) for each bone and the
/// shift of the hips (3 floats, m), little-endian.
inline constexpr std::size_t kPackedBytes = kBoneCount * 4 * 2 + 3 * 4;

/// Palettes of poses of these joints (see pose_palette).
std::string pack(const Joints& joints, std::span<const Palette> palettes);

/// The reverse, to within 0.1 mm. `bytes` is a multiple of kPackedBytes long. Throws
/// std::out_of_range when it holds what is no pose.
std::vector<Palette> unpack(const Joints& joints, std::string_view bytes);

}  // namespace throng::skinning
