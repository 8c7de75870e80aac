// The policy "hover": stays at the start.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_hover_policy(const PolicyContext& context);

}  // namespace throng::sim
