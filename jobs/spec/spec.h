// The job: what a user asks for. Parsed and checked against one JSON Schema
// (jobs/spec/job.schema.json), then against what only a program can know (the scenario exists,
// times are in order, ...).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/options.h"
#include "jobs/spec/camera_spec.h"
#include "jobs/spec/environment.h"
#include "jobs/spec/randomize.h"
#include "jobs/spec/recorded_spec.h"
#include "places/generate.h"
#include "render/quality.h"
#include "sim/run.h"
#include "skinning/appearance.h"

namespace throng::jobs {

struct DroneSpec {
  sim::DroneMission mission;
  CameraSpec camera;
};

struct CaptureSpec {
  double rate_hz = 1;
  double from_s = 0;
  double to_s = 60;
};

struct OutputSpec {
  std::string image_format = "jpeg";
  int image_quality = 95;
  std::vector<std::string> annotations = {"coco", "density", "exits"};
  double density_sigma_px = 4;
  int previews = 3;
  std::vector<std::string> formats;  ///< other formats, below formats/ in the dataset
  formats::ExportOptions exports;
};

struct JobSpec {
  std::string name;
  std::string scenario;  ///< its id; of one that is generated: "generated/" and its parameters
  std::optional<places::PlaceSpec> generate;  ///< the place is made from a seed
  std::uint64_t seed = 1;
  int runs = 1;
  std::optional<int> agents;
  sim::CrowdSpec crowd;
  std::optional<RecordedSpec> recorded;  ///< replayed instead of simulating people
  std::vector<DroneSpec> drones;
  CaptureSpec capture;
  EnvironmentSpec environment;
  render::Quality quality = render::Quality::standard;
  skinning::Styling styling{.umbrellas = 0.05};  ///< of people; umbrellas when it rains
  double props_density = 1;  ///< share of the scenario's scattered props that are there
  OutputSpec outputs;
  std::vector<RandomField> randomize;  ///< drawn for each run by job_of_run()

  /// Frames of one camera in one run, at from_s, from_s + 1/rate_hz, ... up to to_s (included).
  std::int64_t frames_per_camera() const;
  double frame_time_s(std::int64_t frame) const;
};

/// Parses and checks a job. `source` names the text in errors ("demo.job.json", or "" for a request
/// body). `scenarios` is the folder of scenarios. Throws InputError with a JSON pointer per
/// problem; all schema problems are reported at once.
JobSpec parse_job(std::string_view json, const std::string& source,
                  const std::filesystem::path& scenarios);

/// The job as JSON with every default filled in; parse_job reads it back to the same job.
nlohmann::json to_json(const JobSpec& job);

/// How people look in this weather: umbrellas are up when it rains.
skinning::Styling styling_in(const JobSpec& job, render::Weather weather);

/// The job as one of its runs has it: the fields of `randomize` have their drawn values there.
JobSpec job_of_run(const JobSpec& job, int run);

/// Everything that was drawn for a run, by dotted path: fields of `randomize`, of the environment
/// and of the cameras.
nlohmann::json drawn_of_run(const JobSpec& job, int run);

/// The JSON Schema text, embedded at build time.
std::string_view job_schema();

}  // namespace throng::jobs
