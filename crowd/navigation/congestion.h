// Queues of people, and how much longer it takes to walk there.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "crowd/agents/agents.h"
#include "crowd/elements/shapes.h"

namespace throng::crowd {

/// How slowly people get ahead in cells of 1 m or, of large areas, a millionth of the area. Queues
/// cost time; people who walk as fast as they like cost none, however many they are. Const member
/// functions may be called from several threads.
class Congestion {
 public:
  /// A congestion that stays nil.
  Congestion() = default;
  /// People outside of the area do not count.
  explicit Congestion(const Box& area);

  /// Updates how fast everybody has got ahead lately, and with it the cells; called every 0.5 s.
  void observe(const Agents& agents);

  /// Whether nobody queues.
  bool is_nil() const { return slow_cells_ == 0; }
  /// The length of free walking (m) that takes as long as the delay on the straight way from a to
  /// b.
  float delay_m(const Eigen::Vector2f& a, const Eigen::Vector2f& b) const;

 private:
  struct Cell {
    float people = 0;
    float slowness = 0;  // sum over the people; then: further length per length of the way
  };

  void count(const Agents& agents);
  bool is_slow(const Agents& agents, std::size_t agent) const;
  std::size_t cell_at(const Eigen::Vector2f& place) const;

  std::vector<float> progress_;  // by agent: recent speed ahead over the preferred one
  Box area_;
  float cell_m_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  Box slow_;  // around all slow people
  std::size_t slow_cells_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace throng::crowd
