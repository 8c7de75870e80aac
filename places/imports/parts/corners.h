// Corners of a polygon.
#pragma once

#include <Eigen/Core>
#include <vector>

namespace throng::imports {

/// The corners (m) of a polygon, counter-clockwise from above, the first one not repeated at the
/// end.
using Corners = std::vector<Eigen::Vector2d>;

}  // namespace throng::imports
