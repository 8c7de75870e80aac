// The roads of a world: bands of ground along a line.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "places/imports/gazebo/world_ground.h"

namespace sdf {
inline namespace v12 {
class Element;
}  // namespace v12
}  // namespace sdf

namespace throng::imports {

/// Adds the ground of a <road> to `flat`. Returns why it has none, or nothing.
std::optional<std::string> add_road(const std::shared_ptr<sdf::Element>& road,
                                    std::vector<FlatArea>& flat);

}  // namespace throng::imports
