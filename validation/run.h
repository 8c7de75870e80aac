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

/// Returns the deepest overlap of two bodies, m; negative if nobody touches anybody.
double deepest_overlap_m(const crowd::Simulation& crowd);

/// Number of people who are present.
std::size_t count_present(const crowd::Simulation& crowd);

}  // namespace throng::validation
