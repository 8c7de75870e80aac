// The policy "orbit": circles a point at the height of the start, with the camera toward the point.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_orbit_policy(const PolicyContext& context);

}  // namespace throng::sim
