// "survey": fly to and fro over an area in lanes, so near each other that neighboring images
// overlap, and begin again when all of it has been seen.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_survey_policy(const PolicyContext& context);

}  // namespace throng::sim
