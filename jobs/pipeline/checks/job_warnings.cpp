#include "jobs/pipeline/checks/job_warnings.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "formats/export/exporter.h"
#include "jobs/pipeline/runs/run_input.h"
#include "sim/planning/planned_paths.h"
#include "spec/annotate/ground_truth.h"
#include "spec/job/environment.h"
#include "spec/job/plan.h"
#include "spec/job/scenario_mix.h"
#include "spec/job/spec.h"

namespace throng::jobs {

namespace {

constexpr int kMaxRuns = 3;        // whose views are looked at
constexpr double kFarM = 100;      // from the scenario's ground
constexpr double kMinPixels = 10;  // of a person's height, for labels of any use

void check_rain(const JobSpec& job, std::vector<Problem>& warnings) {
  const nlohmann::json asked = to_json(job.environment);
  const nlohmann::json usual = to_json(EnvironmentSpec());
  const char* field = "rain_mm_per_h";
  if (asked.value(field, nlohmann::json()) == usual.value(field, nlohmann::json())) return;
  for (const RunPlan& run : plan_runs(job)) {
    const EnvironmentSpec of_run = job_of_run(job, run.index).environment;
    if (environment_of_run(of_run, run.seed).light.weather == render::Weather::rain) return;
  }
  warnings.push_back({"", "/environment/rain_mm_per_h",
                      fmt::format("{} mm/h, but rain in no run", asked.at(field).dump()),
                      "\"rain\" in /environment/weather"});
}

void check_smoke(const JobSpec& job, const world::Scenario& scenario,
                 std::vector<Problem>& warnings) {
  if (to_json(job.environment).value("smoke", nlohmann::json(0)) == 0) return;
  if (!scenario.disaster_agents.empty() || !scenario.disasters.empty()) return;
  warnings.push_back({"", "/environment/smoke",
                      fmt::format("smoke in {}, which has no hazard to rise from", scenario.id),
                      "a scenario with hazards"});
}

// Scenarios of which the job has no run.
void check_shares(const JobSpec& job, std::vector<Problem>& warnings) {
  const std::vector<std::size_t> shares = shares_of_runs(job);
  for (std::size_t i = 0; i < job.mix.size(); ++i) {
    if (std::find(shares.begin(), shares.end(), i) != shares.end()) continue;
    warnings.push_back(
        {"", fmt::format("/scenario/{}", i),
         fmt::format("\"{}\", which has no run of {}", job.mix[i].scenario, job.runs),
         "more runs, or a greater weight"});
  }
}

void check_ground_truth(const JobSpec& job, std::vector<Problem>& warnings) {
  const std::vector<std::string>& names = job.outputs.annotations;
  if (annotate::holds(names, annotate::GroundTruth::coco)) return;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const annotate::GroundTruthKind* kind = annotate::find_kind(names[i]);
    if (kind == nullptr || !kind->in_coco) continue;
    warnings.push_back({"", fmt::format("/outputs/annotations/{}", i),
                        fmt::format("\"{}\" without \"coco\", whose file holds it", names[i]),
                        "\"coco\" in /outputs/annotations"});
  }
}

void check_splits(const JobSpec& job, std::vector<Problem>& warnings) {
  formats::DatasetInfo info;
  info.options = job.outputs.exports;
  for (const RunPlan& run : plan_runs(job)) info.runs.push_back(run_name(run.index));
  const std::vector<formats::Split> used = info.splits();
  for (std::size_t i = 0; i < formats::kSplitNames.size(); ++i) {
    const auto split = static_cast<formats::Split>(i);
    if (!(info.options.splits.share[i] > 0)) continue;
    if (std::find(used.begin(), used.end(), split) != used.end()) continue;
    warnings.push_back({"", fmt::format("/outputs/splits/{}", formats::to_string(split)),
                        fmt::format("a share of {:g}, which is no run of {}",
                                    info.options.splits.share[i], job.runs),
                        "more runs, or a larger share: runs are not divided"});
  }
}

/// Whether an angle is more likely one in radians than in degrees: a usual one, such as -1.57, or a
/// pitch that no one gives in degrees, since it looks to the horizon.
bool may_be_radians(std::string_view name, double degrees) {
  constexpr double kPart = std::numbers::pi / 12;
  constexpr double kRounding = 0.003;
  if (degrees == std::round(degrees)) return false;
  if (name == "pitch_deg" && degrees < -0.2) return degrees > -std::numbers::pi / 2 - kRounding;
  const double parts = std::round(degrees / kPart);
  return parts != 0 && std::abs(degrees) < 2 * std::numbers::pi + kRounding &&
         std::abs(degrees - parts * kPart) < kRounding;
}

void check_angles(const JobSpec& job, std::vector<Problem>& warnings) {
  constexpr std::array kAngles = {"pitch_deg", "yaw_deg"};
  const nlohmann::json fields = to_json(job);
  for (std::size_t i = 0; i < job.drones.size(); ++i) {
    for (const char* angle : kAngles) {
      const std::string pointer = fmt::format("{}/{}", camera_pointer(i), angle);
      const nlohmann::json::json_pointer place(pointer);
      if (!fields.contains(place) || !fields.at(place).is_number()) continue;
      const auto degrees = fields.at(place).get<double>();
      if (!may_be_radians(angle, degrees)) continue;
      warnings.push_back(
          {"", pointer, fmt::format("{:g} degrees", degrees),
           fmt::format("{:.0f} if it is meant in radians", degrees * 180 / std::numbers::pi)});
    }
  }
}

double ground_distance_m(const world::Rectangle& area, const Eigen::Vector3d& point) {
  const Eigen::Vector2d on_ground = point.head<2>();
  return (on_ground - area.nearest_point(on_ground, 0)).norm();
}

void check_distances(const JobSpec& job, const world::Scenario& scenario,
                     const StartingCrowd& crowd, int run, std::vector<Problem>& warnings) {
  world::Rectangle area = scenario.ground;
  area.extend(scenario.inside.bounds);
  const auto paths = sim::planned_paths(scenario, run_spec(job, run), crowd.aimed_at);
  for (std::size_t i = 0; i < paths.size(); ++i) {
    double max_distance_m = 0;
    for (const Eigen::Vector3d& point : paths[i].points) {
      max_distance_m = std::max(max_distance_m, ground_distance_m(area, point));
    }
    if (max_distance_m <= kFarM) continue;
    warnings.push_back(
        {"", fmt::format("/drones/{}", i),
         fmt::format("a path up to {:.0f} m beyond the scenario's ground", max_distance_m),
         fmt::format("at most {:.0f} m, where people can be seen", kFarM)});
  }
}

void check_view(const CameraView& view, std::size_t drone, std::vector<Problem>& warnings) {
  const std::string pointer = camera_pointer(drone);
  if (view.max_person_px == 0) {
    warnings.push_back({"", pointer, "nobody in any image, wherever people walk",
                        "a view of people: position, heading, pitch_deg or hfov_deg"});
  } else if (view.max_person_px < kMinPixels) {
    warnings.push_back({"", pointer, fmt::format("people of at most {:.0f} px", view.max_person_px),
                        fmt::format("at least {:.0f} px: a lower drone, a narrower lens or a "
                                    "larger image",
                                    kMinPixels)});
  }
}

}  // namespace

std::vector<Problem> warnings_of_settings(const JobSpec& job) {
  std::vector<Problem> warnings;
  check_rain(job, warnings);
  check_shares(job, warnings);
  check_ground_truth(job, warnings);
  check_splits(job, warnings);
  check_angles(job, warnings);
  return warnings;
}

std::vector<Problem> scenario_warnings(const JobSpec& job, const world::Scenario& scenario,
                                       const StartingCrowd& crowd, int first_run) {
  std::vector<Problem> warnings;
  check_smoke(job, scenario, warnings);
  check_distances(job, scenario, crowd, first_run, warnings);
  std::vector<CameraView> best(job.drones.size());
  std::vector<bool> is_known(job.drones.size(), true);
  for (int run = first_run; run < std::min(job.runs, first_run + kMaxRuns); ++run) {
    const auto views = views_of_run(job, scenario, crowd, run);
    for (std::size_t i = 0; i < best.size(); ++i) {
      is_known[i] = is_known[i] && views[i].has_value();
      if (!views[i]) continue;
      best[i].max_person_px = std::max(best[i].max_person_px, views[i]->max_person_px);
    }
  }
  for (std::size_t i = 0; i < best.size(); ++i) {
    if (is_known[i]) check_view(best[i], i, warnings);
  }
  return warnings;
}

}  // namespace throng::jobs
