// The list of labels at the beginning of CVAT's files for images and for videos.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/dataset/dataset.h"

namespace throng::formats {

/// Min hidden share of a body that counts as occluded in CVAT.
inline constexpr double kCvatOccluded = 0.005;

/// The element <labels> with all classes, each with text attributes of these names.
std::string cvat_labels(const DatasetInfo& info, const std::vector<std::string_view>& attributes);

}  // namespace throng::formats
