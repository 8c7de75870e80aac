// The views of a job's cameras, as far as they are known before the simulation: which part of the
// place they show, how large people are in them, and whether anybody can be in them at all.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// Positions (m) and speeds (m/s) of people as the run begins; those who arrive later may be
/// anywhere.
struct StartingCrowd {
  std::vector<Eigen::Vector2d> places = {};
  double max_speed_mps = 0;
  bool has_arrivals = false;
};

/// A camera's images over the capture.
struct CameraView {
  std::string drone;
  double max_area_share = 0;  ///< largest share of the scenario's `inside` in one image, 0 to 1
  double max_person_px = 0;   ///< largest height of a person in an image, pixels; 0: nobody
  double mean_people = 0;     ///< of those at the start who would be in an image, over the images
};

/// The views of a run's cameras. Nothing of drones whose path depends on the people they see.
/// Buildings hide nobody here, and people walk straight at up to twice their speed: a person who is
/// not in these views is in no image.
std::vector<std::optional<CameraView>> views_of_run(const JobSpec& job,
                                                    const world::Scenario& scenario,
                                                    const StartingCrowd& crowd, int run);

/// {"drone", "max_area_share", "max_person_px"}
nlohmann::json to_json(const CameraView& view);

}  // namespace throng::jobs
