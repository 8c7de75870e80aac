// A job as a value. spec/job/spec.h reads and prints it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "spec/annotate/count_areas.h"
#include "spec/annotate/ground_truth.h"
#include "spec/formats/options.h"
#include "spec/job/camera_spec.h"
#include "spec/job/environment.h"
#include "spec/job/randomize.h"
#include "spec/job/recorded_spec.h"
#include "spec/render/quality.h"
#include "spec/scenarios/generator_spec.h"
#include "spec/sim/run_spec.h"
#include "spec/skinning/styling.h"

namespace throng::jobs {

/// A drone of a job: its mission and its camera.
struct DroneSpec {
  sim::DroneMission mission;
  CameraSpec camera;
  /// File of the mission's set-points, until resolve() has read it.
  std::filesystem::path pilot_log;
};

/// Times of the frames of all cameras, in simulated time.
struct CaptureSpec {
  double rate_hz = 1;
  double from_s = 0;
  double to_s = 60;
  std::optional<double> run_to_s;  ///< where the run goes on after the last frame

  /// When the run ends.
  double end_s() const { return std::max(to_s, run_to_s.value_or(to_s)); }
};

/// Images, ground truth and exports that a job writes.
struct OutputSpec {
  std::string image_format = "jpeg";
  int image_quality = 95;
  std::vector<std::string> annotations = annotate::default_ground_truth();
  double density_sigma_px = 4;
  std::vector<double> field_cells_m;  ///< cell sizes of grids beyond the default one
  annotate::CountAreas counts;        ///< those of the job; the ground and exits are always counted
  int previews = 3;
  std::vector<std::string> formats;  ///< formats of exports, below formats/ in the dataset
  std::string
      publish;  ///< address (spec/bucket/address.h) to which the dataset is published; "": none
  formats::ExportOptions exports;
};

/// Limits of a job.
inline constexpr int kMaxJobRuns = 1000;
inline constexpr int kMaxJobAgents = 1'000'000;

/// One of several scenarios of a job.
struct ScenarioShare {
  std::string scenario;                              ///< as JobSpec::scenario
  std::optional<scenarios::GeneratorSpec> generate;  ///< as JobSpec::generate
  bool is_new_each_run = false;                      ///< generated from another seed for each run
  double weight = 1;                                 ///< relative number of its runs
  std::optional<int> agents;                         ///< overrides the job's
};

/// A whole job; docs/reference/job.md describes the fields.
struct JobSpec {
  std::string name;
  std::string scenario;  ///< its id; that of a generated one is generated_scenario_id()
  std::optional<scenarios::GeneratorSpec> generate;  ///< parameters of a generated scenario
  /// Several scenarios, among which the runs are divided (spec/job/scenario_mix.h); `scenario` and
  /// `generate` are then those of the first. Empty for a job with one scenario.
  std::vector<ScenarioShare> mix;
  std::uint64_t seed = 1;
  int runs = 1;
  std::optional<int> agents;
  sim::CrowdSpec crowd;
  std::optional<RecordedSpec> recorded;  ///< replayed instead of simulating people
  std::vector<DroneSpec> drones;
  /// No drones, whatever the scenario has: the job computes metrics without images.
  bool is_without_drones = false;
  CaptureSpec capture;
  EnvironmentSpec environment;
  render::Quality quality = render::Quality::standard;
  /// Styling of people; `umbrellas` applies only in rain.
  skinning::Styling styling{.umbrellas = 0.33};
  double props_density = 1;  ///< share of the scenario's scattered props that are present
  OutputSpec outputs;
  std::vector<RandomField> randomize;  ///< sampled for each run by job_of_run()

  /// Number of frames of one camera in one run: at from_s, from_s + 1/rate_hz, ..., to_s
  /// (included).
  std::int64_t frames_per_camera() const;
  double frame_time_s(std::int64_t frame) const;
};

}  // namespace throng::jobs
