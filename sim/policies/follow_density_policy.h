// The policy "follow_density": keeps the camera on the densest part of the crowd. The drone flies
// so that the optical axis of its camera, as mounted, meets the ground there.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_follow_density_policy(const PolicyContext& context);

}  // namespace throng::sim
