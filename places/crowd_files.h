// The Menge files of a blueprint's people.
#pragma once

#include <string>
#include <vector>

#include "base/error.h"
#include "places/people.h"
#include "places/standing.h"

namespace throng::places {

/// What a blueprint becomes for the crowd.
struct CrowdFiles {
  std::string scene;
  std::string behavior;
};

/// An exit's goals in the behaviour file: for who leaves as always, and for who flees.
inline constexpr int kLeavingSet = 5;
inline constexpr int kFleeingSet = 3;
inline constexpr int kGuidesSet = 99;

/// Writes the files. Adds to `problems` where people find no room.
CrowdFiles write_crowd(const world::Scenario& scenario, const People& people,
                       std::vector<Problem>& problems);

}  // namespace throng::places
