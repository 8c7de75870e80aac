// Compressed palettes in files: the rotation of each bone and the position of the hips. The rest
// follows from the joints.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "skinning/skeleton.h"

namespace throng::skinning {

/// Size of one palette in bytes: a unit quaternion (x, y, z, w; 16-bit, 32767 is 1) for each bone,
/// and the shift of the hips (3 floats, m); little-endian.
inline constexpr std::size_t kPackedBytes = kBoneCount * 4 * 2 + 3 * 4;

/// Compresses palettes, which must be results of pose_palette() for these joints.
std::string pack(const Joints& joints, std::span<const Palette> palettes);

/// The inverse of pack(), to within 0.1 mm. The size of `bytes` must be a multiple of kPackedBytes.
/// Throws std::out_of_range if a quaternion or the shift is invalid.
std::vector<Palette> unpack(const Joints& joints, std::string_view bytes);

}  // namespace throng::skinning
