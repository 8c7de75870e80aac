// Execution of a scene, shared by the tests.
#pragma once

#include <functional>
#include <optional>

#include "crowd/simulation.h"

namespace throng::validation {

/// Called after each step.
using Look = std::function<void(const crowd::Simulation&)>;

/// Runs until nobody is left and returns that time (s). Returns nothing after `max_s`, or if nobody
/// has left for a minute: people block each other.
std::optional<double> until_all_left(crowd::Simulation& crowd, double max_s, const Look& look = {});

/// Number of people who are present.
std::size_t count_present(const crowd::Simulation& crowd);

}  // namespace throng::validation
