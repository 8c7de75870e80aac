// Hazards of a scenario in image records, and the danger that they pose to people.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "annotate/people/labels.h"
#include "camera/camera.h"
#include "world/scenario.h"
#include "world/trace.h"

namespace throng::annotate {

/// The hazards at the current time, which only advances.
class HazardView {
 public:
  /// The trace must outlive this object.
  HazardView(const world::Scenario& scenario, const world::Trace& trace);

  /// Sets the current time, which must not be before the previous one.
  void advance(double time_s);

  /// A JSON array of the hazards that have started, as `camera` sees them (docs/formats_coco.md).
  std::string json(const camera::Camera& camera) const;

  /// The danger for an agent at `position` (m); std::nullopt before the first hazard has started.
  std::optional<Danger> danger(std::uint32_t agent, const Eigen::Vector2d& position) const;

 private:
  struct Reach {
    std::size_t hazard = 0;  ///< in the scenario's list
    Eigen::Vector2d center = Eigen::Vector2d::Zero();
    double radius_m = 0;
  };

  /// The extents at a time of the hazards that have started.
  std::vector<Reach> reaches_at(double time_s) const;
  Eigen::Vector2d hazard_center(const world::Disaster& hazard, double time_s) const;

  std::vector<world::Disaster> hazards_;
  const world::Trace* trace_;
  std::vector<Reach> now_;
  std::size_t next_step_ = 0;     ///< the first one that is not in inside_s_
  std::vector<double> inside_s_;  ///< by agent: time within reach of any hazard so far
};

}  // namespace throng::annotate
