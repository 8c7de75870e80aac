// The job as a value: what a user asks for. spec/job/spec.h reads and prints it.
#pragma once

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

struct DroneSpec {
  sim::DroneMission mission;
  CameraSpec camera;
  std::filesystem::path pilot_log;  ///< file of the mission's set-points until resolve() reads it
};

struct CaptureSpec {
  double rate_hz = 1;
  double from_s = 0;
  double to_s = 60;
};

struct OutputSpec {
  std::string image_format = "jpeg";
  int image_quality = 95;
  std::vector<std::string> annotations = annotate::default_ground_truth();
  double density_sigma_px = 4;
  std::vector<double> field_cells_m;  ///< sizes of cells beside the usual one
  annotate::CountAreas counts;        ///< of the job; the ground and exits come with them
  int previews = 3;
  std::vector<std::string> formats;  ///< other formats, below formats/ in the dataset
  std::string
      publish;  ///< address (spec/bucket/address.h) that the dataset is brought to; "": none
  formats::ExportOptions exports;
};

/// One of several scenarios of a job.
struct ScenarioShare {
  std::string scenario;                              ///< as JobSpec::scenario
  std::optional<scenarios::GeneratorSpec> generate;  ///< as JobSpec::generate
  bool is_new_each_run = false;                      ///< generated from another seed for each run
  double weight = 1;                                 ///< runs are shared out by it
  std::optional<int> agents;                         ///< instead of the job's
};

struct JobSpec {
  std::string name;
  std::string scenario;  ///< its id; of one that is generated: "generated/" and its parameters
  std::optional<scenarios::GeneratorSpec> generate;  ///< the scenario is made from a seed
  /// Several scenarios, each of which has a share of the runs (spec/job/scenario_mix.h); scenario
  /// and generate are then those of the first. Empty for a job of one scenario.
  std::vector<ScenarioShare> mix;
  std::uint64_t seed = 1;
  int runs = 1;
  std::optional<int> agents;
  sim::CrowdSpec crowd;
  std::optional<RecordedSpec> recorded;  ///< replayed instead of simulating people
  std::vector<DroneSpec> drones;
  /// Nobody flies, whatever the scenario has: a job for figures, without images.
  bool is_without_drones = false;
  CaptureSpec capture;
  EnvironmentSpec environment;
  render::Quality quality = render::Quality::standard;
  skinning::Styling styling{.umbrellas = 0.05};  ///< of people; umbrellas when it rains
  double props_density = 1;  ///< share of the scenario's scattered props that are there
  OutputSpec outputs;
  std::vector<RandomField> randomize;  ///< sampled for each run by job_of_run()

  /// Frames of one camera in one run, at from_s, from_s + 1/rate_hz, ... up to to_s (included).
  std::int64_t frames_per_camera() const;
  double frame_time_s(std::int64_t frame) const;
};

}  // namespace throng::jobs
