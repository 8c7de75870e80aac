// People who stand in or walk through props. The crowd does not know of props, so a scenario with a
// prop in people's path is wrong, and so would be its images.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "base/error.h"
#include "world/scenario.h"

namespace throng::sim {

class PropWatch {
 public:
  /// The scenario must outlive it.
  explicit PropWatch(const world::Scenario& scenario);

  /// Notes each prop that the middle of somebody who is `there` comes into, but for its edge: a
  /// fifth of its length and width on each side.
  void look(std::span<const Eigen::Vector2f> positions, std::span<const std::uint8_t> there,
            double time_s);

  /// One per prop: which, where, who and when.
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  using Cell = std::pair<int, int>;  ///< of 1 m
  static Cell cell_of(const Eigen::Vector2d& point);
  void record(std::size_t number, std::size_t agent, const Eigen::Vector2d& at, double time_s);

  const world::Scenario* scenario_;
  std::map<Cell, std::vector<std::size_t>> props_in_;
  std::set<std::size_t> noted_;
  std::vector<Problem> problems_;
};

}  // namespace throng::sim
