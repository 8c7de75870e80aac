// The policy "zigzag", after the tele-operator of Huang et al. (2016). At a constant speed, the
// drone sweeps to and fro over the people who run to the most crowded exit, so that they follow it,
// leads them out by another exit, and returns. The other exits take turns.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_zigzag_policy(const PolicyContext& context);

}  // namespace throng::sim
