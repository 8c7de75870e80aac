// Detects people who stand in or walk through props. The crowd engine ignores props, so a prop in
// people's path is a mistake of the scenario that would show in images.
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

/// Observes the positions of people step by step.
class PropWatch {
 public:
  /// `scenario` must outlive this object.
  explicit PropWatch(const world::Scenario& scenario);

  /// Records each prop that contains the position (m) of an agent who is `there` (not 0). A margin
  /// of a fifth of the prop's length and width on each side does not count.
  void look(std::span<const Eigen::Vector2f> positions, std::span<const std::uint8_t> there,
            double time_s);

  /// One problem per prop, with the prop, its position, the agent and the time.
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
