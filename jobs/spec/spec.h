// The job: what a user asks for. Parsing checks it against one JSON Schema
// (jobs/spec/job.schema.json) and against itself; it opens no file. Fields that depend on the
// scenario, and on the files that a job names, are checked by resolve() (jobs/pipeline/resolve.h).
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "annotate/spec/ground_truth.h"
#include "base/error.h"
#include "formats/spec/options.h"
#include "jobs/spec/camera_spec.h"
#include "jobs/spec/environment.h"
#include "jobs/spec/randomize.h"
#include "jobs/spec/recorded_spec.h"
#include "places/spec/place_spec.h"
#include "render/spec/quality.h"
#include "sim/spec/run_spec.h"
#include "skinning/spec/styling.h"

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
  std::vector<RandomField> randomize;  ///< sampled for each run by job_of_run()

  /// Frames of one camera in one run, at from_s, from_s + 1/rate_hz, ... up to to_s (included).
  std::int64_t frames_per_camera() const;
  double frame_time_s(std::int64_t frame) const;
};

/// Throws InputError for a text that is no JSON or not what the schema allows, with a JSON pointer
/// per problem. `source` names the text in errors ("demo.job.json", or "" for a request body).
void check_job_schema(std::string_view json, const std::string& source);

/// Parses a job; what is wrong beyond the schema is added to `problems`. Throws like
/// check_job_schema().
JobSpec parse_job(std::string_view json, const std::string& source, std::vector<Problem>& problems);

/// The same, throwing InputError with all problems.
JobSpec parse_job(std::string_view json, const std::string& source);

/// The job as JSON with every default filled in that does not depend on the scenario; parse_job
/// reads it back to the same job.
nlohmann::json to_json(const JobSpec& job);

/// How people look in this weather: umbrellas are up when it rains.
skinning::Styling styling_in(const JobSpec& job, render::Weather weather);

/// The job as one of its runs has it: the fields of `randomize` have their sampled values there.
JobSpec job_of_run(const JobSpec& job, int run);

/// Everything that was sampled for a run, by dotted path: fields of `randomize`, of the environment
/// and of the cameras.
nlohmann::json samples_of_run(const JobSpec& job, int run);

/// The JSON Schema of a job.
const nlohmann::json& job_schema();
/// The same as text, whose fields are in the order of docs/job.md.
std::string_view job_schema_text();

}  // namespace throng::jobs
