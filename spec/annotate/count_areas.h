// Zones in which people are counted, and lines whose crossings are counted, on the ground.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace throng::annotate {

/// A polygon in which people are counted.
struct CountZone {
  std::string id;
  std::vector<Eigen::Vector2d> corners;  ///< corners of a simple polygon, m
};

/// A directed segment. A crossing toward the left of the direction from `from` to `to` is inward.
struct CountLine {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
};

/// The zones and lines of a job.
struct CountAreas {
  std::vector<CountZone> zones;
  std::vector<CountLine> lines;

  bool empty() const { return zones.empty() && lines.empty(); }
};

}  // namespace throng::annotate
