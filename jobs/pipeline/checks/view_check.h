// Predicted views of a job's cameras, before the simulation: which part of the scenario they show,
// how large people appear, and whether any person can be visible.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/error.h"
#include "spec/job/spec.h"
#include "world/scenario.h"

namespace throng::jobs {

/// People at the start of a run.
struct StartingCrowd {
  std::vector<Eigen::Vector2d> places = {};    ///< positions, m
  std::size_t times = 1;                       ///< number of times at which these were taken
  double max_speed_mps = 0;                    ///< greatest preferred speed
  bool has_arrivals = false;                   ///< people arrive later, at unknown positions
  std::vector<Eigen::Vector2d> aimed_at = {};  ///< positions of those at whom drones aim, m
};

/// Predicted content of a camera's images over the capture.
struct CameraView {
  std::string drone;          ///< id
  double max_area_share = 0;  ///< greatest share of the scenario's `inside` in one image, 0 to 1
  double max_person_px = 0;   ///< greatest height of a person in an image, pixels; 0: nobody
  double mean_people = 0;     ///< mean number of places of StartingCrowd per image
};

/// The views of a run's cameras; std::nullopt for drones whose paths depend on the people they see.
/// The prediction is an upper bound: buildings hide nobody, and people walk straight at up to twice
/// their speed. A person who is not in these views is in no image.
std::vector<std::optional<CameraView>> views_of_run(const JobSpec& job,
                                                    const world::Scenario& scenario,
                                                    const StartingCrowd& crowd, int run);

/// {"drone", "max_area_share", "max_person_px"}
nlohmann::json to_json(const CameraView& view);

}  // namespace throng::jobs
