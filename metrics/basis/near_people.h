// People near an exit at one step, as far as its figures need them.
#pragma once

#include <Eigen/Core>
#include <cstddef>

namespace throng::metrics {

struct NearPerson {
  std::size_t agent = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();     ///< m
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< m/s
  double desired_speed_mps = 0;
  bool comes_here = false;  ///< intends this exit; everybody does where intents are unknown
};

}  // namespace throng::metrics
