// "zigzag": the tele-operator of Huang et al. (2016). Flies at a constant speed: sweeps to and fro
// over those who run to the exit with the most people before it, people following, leads them out
// by another exit, and comes back for more. Takes the exits in turn.
#pragma once

#include <memory>

#include "sim/policies/policy.h"

namespace throng::sim {

std::unique_ptr<Policy> make_zigzag_policy(const PolicyContext& context);

}  // namespace throng::sim
