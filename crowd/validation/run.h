// Shared by the tests: running a scene to its end and watching who goes where.
#pragma once

#include <functional>
#include <optional>

#include "crowd/simulation.h"

namespace throng::validation {

using Look = std::function<void(const crowd::Simulation&)>;

/// Steps, and looks after each, until nobody is left: returns that time in s. Nothing when that
/// takes longer than `max_s`, or when nobody has left for a minute: then people block each other.
std::optional<double> until_all_left(crowd::Simulation& crowd, double max_s, const Look& look = {});

std::size_t count_present(const crowd::Simulation& crowd);

}  // namespace throng::validation
