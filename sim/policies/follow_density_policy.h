// "follow_density": keep the camera on where the crowd is densest: the drone flies so that the
// camera's axis, as it is mounted, meets the ground there.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_follow_density_policy(const PolicyContext& context);

}  // namespace throng::sim
