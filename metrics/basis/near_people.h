// People near an exit at one step, the input of its metrics.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace throng::metrics {

/// A person near an exit.
struct NearPerson {
  std::size_t agent = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();     ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double desired_speed_mps = 0;
  bool comes_here = false;  ///< intends this exit; true for all if intents are unknown
};

}  // namespace throng::metrics
