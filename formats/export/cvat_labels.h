// The list of labels that CVAT's files for images and for videos begin with.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/dataset/dataset.h"

namespace throng::formats {

/// Shares of a body that is hidden below this do not count as occluded in CVAT.
inline constexpr double kCvatOccluded = 0.005;

/// The element <labels>: the classes, with text attributes of these names.
std::string cvat_labels(const DatasetInfo& info, const std::vector<std::string_view>& attributes);

}  // namespace throng::formats
