// Exits in image records: outlines of their doorways and control zones in the image, and their
// state.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "metrics/exits/exits.h"
#include "world/scenario.h"

namespace throng::annotate {

/// The exits of one run.
class ExitView {
 public:
  /// `exits` must be the series of the scenario's exits, sampled at `step_times_s`.
  ExitView(const world::Scenario& scenario, std::vector<metrics::ExitSeries> exits,
           std::vector<double> step_times_s);

  /// A JSON array with an object for each exit (docs/formats.md). Its polygons on the ground are as
  /// in append_ground_polygon().
  std::string json(const camera::Camera& camera, double time_s) const;

 private:
  struct Outlines {
    std::string id;                     ///< JSON
    std::vector<Eigen::Vector2d> door;  ///< on the ground, m
    std::vector<Eigen::Vector2d> zone;  ///< on the ground, m
  };
  std::vector<Outlines> outlines_;
  std::vector<metrics::ExitSeries> exits_;
  std::vector<double> step_times_s_;
};

/// The index of the last step at or before a time; 0 if there is none.
std::size_t step_at(std::span<const double> step_times_s, double time_s);

}  // namespace throng::annotate
