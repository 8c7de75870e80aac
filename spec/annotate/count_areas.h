// Zones and lines on the ground that people are counted in and across.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace throng::annotate {

struct CountZone {
  std::string id;
  std::vector<Eigen::Vector2d> corners;  ///< of a simple polygon, m
};

/// Crossings to the left of the way from `from` to `to` are inward.
struct CountLine {
  std::string id;
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< m
  Eigen::Vector2d to = Eigen::Vector2d::Zero();    ///< m
};

struct CountAreas {
  std::vector<CountZone> zones;
  std::vector<CountLine> lines;

  bool empty() const { return zones.empty() && lines.empty(); }
};

}  // namespace throng::annotate
