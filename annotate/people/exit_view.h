// Exits as a camera sees them: where their doorways and control zones are in the image, and what
// happens there.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "camera/camera.h"
#include "metrics/exits/exits.h"
#include "world/scenario.h"

namespace throng::annotate {

class ExitView {
 public:
  /// `exits` are those of the scenario, with samples at `step_times_s`.
  ExitView(const world::Scenario& scenario, std::vector<metrics::ExitSeries> exits,
           std::vector<double> step_times_s);

  /// A JSON array with an object for each exit (docs/formats.md). Polygons lie on the ground and
  /// are in box coordinates, cut off where they pass behind the camera or where its lens shows
  /// nothing, and not at the image's borders; empty when nothing of them would be in the image.
  std::string json(const camera::Camera& camera, double time_s) const;

 private:
  struct Outlines {
    std::string id;                     ///< JSON
    std::vector<Eigen::Vector2d> door;  ///< m, on the ground
    std::vector<Eigen::Vector2d> zone;
  };
  std::vector<Outlines> outlines_;
  std::vector<metrics::ExitSeries> exits_;
  std::vector<double> step_times_s_;
};

/// The index of the last step at or before a time, or 0.
std::size_t step_at(std::span<const double> step_times_s, double time_s);

}  // namespace throng::annotate
