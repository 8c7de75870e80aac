// Warnings about a run whose drones could not carry out their missions.
#pragma once

#include <set>
#include <utility>
#include <vector>

#include "base/error.h"
#include "world/trace.h"

namespace throng::sim {

/// Collects the first event of each kind that reports that a drone cannot hold its position or has
/// hit something.
class HoldWarnings {
 public:
  void record(const world::TraceEvent& event);

  /// One warning per kind and drone, with the drone's JSON pointer in the job.
  const std::vector<Problem>& warnings() const { return warnings_; }

 private:
  std::set<std::pair<std::int32_t, std::size_t>> noted_;  ///< drone and kind
  std::vector<Problem> warnings_;
};

}  // namespace throng::sim
