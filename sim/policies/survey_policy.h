// The policy "survey": flies over an area in parallel lanes whose images overlap, and starts again
// after the last lane.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_survey_policy(const PolicyContext& context);

}  // namespace throng::sim
